#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A crate on the ground over three frames; it has these points, each with this separation.
std::string crate_trace(const std::vector<int>& points, const std::string& separation = "-0.02") {
  std::string text =
      R"({"schema":"contactscope.trace/1","scenario":"mine/crate","scalar":"float","up":"y","shapes":{)"
      R"("ground":{"type":"plane","vertices":[],"half_space":{"normal":[0,1,0],"offset":0}},)"
      R"("crate":{"type":"hull","vertices":[[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],)"
      R"([-1,1,1],[1,1,1]]}}})"
      "\n";
  for (std::size_t f = 0; f < points.size(); ++f) {
    text += "{\"frame\":" + std::to_string(f) + ",\"time\":" + std::to_string(0.1 * double(f)) +
            R"(,"poses":{"ground":{"position":[0,0,0],"quat_wxyz":[1,0,0,0]},)"
            R"("crate":{"position":[0,0.98,0],"quat_wxyz":[1,0,0,0]}},"pairs":[{"a":"ground",)"
            R"("b":"crate","manifolds":[{"normal":[0,1,0],"points":[)";
    for (int k = 0; k < points[f]; ++k)
      text += std::string(k > 0 ? "," : "") + R"({"position":[)" + (k % 2 ? "1" : "-1") +
              ",-0.02," + (k / 2 ? "1" : "-1") + R"(],"separation":)" + separation + "}";
    text += "]}]}]}\n";
  }
  return text;
}

TEST(FindVerb, ListsFramesAndPairsAndRenderDrawsThem) {
  const TemporaryFolder folder;
  const std::string file = folder.write("run.jsonl", crate_trace({4, 4, 2}));
  const ProgramRun table = run("find '" + file + "' 'points_lost > 0 and overlap < 3 cm'");
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("points_lost  overlap mm\n"));
  EXPECT_THAT(table.out, HasSubstr("\n2         0.2  ground  crate            2          20\n"));
  EXPECT_EQ(table.err, "1 of 3 frames\n");

  const ProgramRun json = run("find '" + file + "' 'points_lost >= 0 and normal_turn >= 0' --json");
  const auto found = nlohmann::json::parse(json.out)["found"];
  ASSERT_EQ(found.size(), 2u);  // nothing is known of the first frame
  EXPECT_EQ(found[1]["frame"], 2);
  EXPECT_EQ(found[1]["values"]["points_lost"], 2);

  const ProgramRun drawn =
      run("render '" + file + "' --where 'points == 2' --format svg --json --out '" +
          folder.path().string() + "'");
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_THAT(drawn.out, HasSubstr("frame_0002.svg"));
  EXPECT_THAT(drawn.out, Not(HasSubstr("frame_0001.svg")));
}

TEST(FindVerb, GivesPointsWithoutIdsTheSameOnesAsPictures) {
  const TemporaryFolder folder;
  // The third point, at another corner, is new in the second frame.
  const std::string file = folder.write("run.jsonl", crate_trace({2, 3, 3}));
  const ProgramRun found = run("find '" + file + "' 'ids_gained > 0 or ids_lost > 0' --json");
  const auto json = nlohmann::json::parse(found.out)["found"];
  ASSERT_EQ(json.size(), 1u) << found.out;
  EXPECT_EQ(json[0]["frame"], 1);
  EXPECT_EQ(json[0]["values"]["ids_gained"], 1);
  const ProgramRun drawn = run("render '" + file + "' --where 'ids_gained == 1' --format svg " +
                               "--json --out '" + folder.path().string() + "'");
  EXPECT_THAT(drawn.out, HasSubstr("frame_0001.svg"));
  EXPECT_THAT(drawn.out, Not(HasSubstr("frame_0002.svg")));
}

/// A pair that slides slowly, and that two frames leave out.
TEST(FindVerb, CausesOfLintAreFoundWhereTheyWereSeeded) {
  const TemporaryFolder folder;
  std::string text = crate_trace(std::vector<int>(9, 4));
  const std::string pose = R"("crate":{"position":[0,)";
  std::size_t at = 0;
  for (int f = 0; f < 9; ++f) {
    at = text.find(pose, at) + pose.size() - 1;
    text.insert(at, "." + std::string(3, '0') + std::to_string(f) + "0");
    if (f != 3 && f != 6) continue;
    const std::size_t pairs = text.find("\"pairs\":[", at) + 9;
    text.erase(pairs, text.find("\n", pairs) - 2 - pairs);
  }
  const std::string file = folder.write("run.jsonl", text);
  const auto frames = [&](const std::string& condition) {
    const ProgramRun found = run("find '" + file + "' '" + condition + "' --json");
    std::vector<int> numbers;
    const auto json = nlohmann::json::parse(found.out);
    for (const auto& one : json["found"]) {
      EXPECT_EQ(one["a"].get<std::string>() + one["b"].get<std::string>(), "groundcrate")
          << found.out;
      numbers.push_back(one["frame"]);
    }
    return numbers;
  };
  using testing::ElementsAre;
  EXPECT_THAT(frames("lint.pairs_flicker"), ElementsAre(3, 6));
  EXPECT_THAT(frames("lint > 0 and points == 0"), ElementsAre(3, 6));
  EXPECT_THAT(frames("lint.points_flicker"), ElementsAre());
  EXPECT_EQ(frames("not lint").size(), 7u);
  EXPECT_THAT(run("find '" + file + "' lint.pair_flicker").err,
              HasSubstr("did you mean 'pairs_flicker'?"));
  EXPECT_THAT(run("find '" + file + "' \"lint == 'pairs_flicker'\"").err,
              HasSubstr("left of '==' is a count, right of it a text"));
  const ProgramRun drawn = run("render '" + file + "' --where lint --format svg --json --out '" +
                               folder.path().string() + "'");
  EXPECT_THAT(drawn.out, testing::AllOf(HasSubstr("frame_0003.svg"), HasSubstr("frame_0006.svg"),
                                        Not(HasSubstr("frame_0002.svg"))));
}

/// Findings below a threshold are left out, counted in a note, and found with --strict.
TEST(FindVerb, StrictIncludesWhatLintCountsBelowItsThreshold) {
  const TemporaryFolder folder;
  std::string text = crate_trace(std::vector<int>(300, 4));
  // In the last three frames the depth is beyond the tolerance of 3.5 mm.
  std::size_t line = text.rfind('\n', text.size() - 2);
  for (const char* separation : {"-0.0245", "-0.0245", "-0.0240"}) {
    for (std::size_t at = line; (at = text.find("-0.02}", at)) != std::string::npos; at += 8)
      text.replace(at, 5, separation);
    line = text.rfind('\n', line - 1);
  }
  const std::string file = folder.write("run.jsonl", text);
  const ProgramRun found = run("find '" + file + "' 'lint.separation > 0'");
  EXPECT_EQ(found.exit_code, 1) << found.out;
  EXPECT_THAT(found.err,
              HasSubstr("note: lint.separation leaves out 3 below the threshold of 2 %"));
  const ProgramRun strict = run("find '" + file + "' 'lint.separation > 0' --strict");
  EXPECT_EQ(strict.exit_code, 0) << strict.err;
  EXPECT_EQ(strict.err, "3 of 300 frames\n");
  EXPECT_EQ(run("find '" + file + "' 'lint.separation > 0' --strict --ignore separation").exit_code,
            1);
}

TEST(FindVerb, ExitCodesAndErrors) {
  const TemporaryFolder folder;
  const std::string file = folder.write("run.jsonl", crate_trace({4, 4}));
  EXPECT_EQ(run("find '" + file + "' 'points > 4'").exit_code, 1);
  EXPECT_EQ(run("render '" + file + "' --where 'points > 4' --format svg").exit_code, 1);
  const ProgramRun wrong = run("find '" + file + "' 'overlp > 5 mm'");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("column 1 of 'overlp > 5 mm': 'overlp' is not a quantity; did "
                                   "you mean 'overlap'?"));
  for (const std::string word : {"penetration", "depth", "Overlap"})
    EXPECT_THAT(run("find '" + file + "' '" + word + " > 5 mm'").err,
                HasSubstr("'" + word + "' is not a quantity; did you mean 'overlap'?"));
  EXPECT_THAT(run("find '" + file + "' 'velocity > 3'").err,
              HasSubstr("did you mean 'motion'? it is in metres since the frame before; known:"));
  EXPECT_THAT(run("find '" + file + "' \"a == 'grund'\"").err,
              HasSubstr("no shape is named 'grund'; did you mean 'ground'?"));
  EXPECT_THAT(run("find 'points > 4' '" + file + "'").err, HasSubstr("the file comes first"));
  // Longer than the name of a file may be.
  const std::string often(60, '('), end(60, ')');
  std::string all = "points > 4";
  for (int i = 0; i < 30; ++i) all += " or points > 4";
  EXPECT_EQ(run("find '" + file + "' '" + often + all + end + "'").exit_code, 1);
  EXPECT_THAT(run("why '" + file + "' --pair ground,crate --frames 99").err,
              HasSubstr("none of --frames has this pair, which is in frames 0"));
  const std::string broken = folder.write("broken.jsonl", crate_trace({4}) + "{\"frame\":1,}\n");
  const ProgramRun bad = run("find '" + broken + "' 'points > 4'");
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.err, HasSubstr("broken.jsonl:3:"));
}

TEST(DiffVerb, ReportsTheFirstDifference) {
  const TemporaryFolder folder;
  const std::string a = folder.write("a.jsonl", crate_trace({4, 4, 4}));
  const std::string b = folder.write("b.jsonl", crate_trace({4, 3, 4}));
  const ProgramRun same = run("diff '" + a + "' '" + a + "'");
  EXPECT_EQ(same.exit_code, 0);
  EXPECT_EQ(same.out, "the same: 3 frames\n");
  std::string spaced = crate_trace({4, 4, 4});
  for (std::size_t i = 0; (i = spaced.find(",\"", i)) != spaced.npos; i += 2)
    spaced.insert(i + 1, " ");
  const std::string other = folder.write("spaced.jsonl", spaced);
  EXPECT_EQ(run("diff '" + a + "' '" + other + "'").out, "the same: 3 frames\n");
  const ProgramRun text = run("diff '" + a + "' '" + b + "'");
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_THAT(text.out, HasSubstr("first in frame 1, ground-crate, stage: points"));
  const auto json = nlohmann::json::parse(run("diff '" + a + "' '" + b + "' --json").out);
  EXPECT_EQ(json["same"], false);
  EXPECT_EQ(json["equal"], 2);
  EXPECT_EQ(json["first"]["frame"], 1);
  EXPECT_EQ(json["first"]["b"], "crate");
  EXPECT_EQ(json["first"]["stage"], "points");
  EXPECT_EQ(run("diff '" + a + "'").exit_code, 2);
  EXPECT_THAT(text.out, HasSubstr("  point 3 gone\n")) << "points without ids";
}

/// A run of three balls in a row on the ground, as JSON: the header and three frames.
std::vector<nlohmann::ordered_json> row_of_balls() {
  const auto parse = [](const std::string& text) { return nlohmann::ordered_json::parse(text); };
  std::vector<nlohmann::ordered_json> lines = {parse(
      R"({"schema":"contactscope.trace/1","scenario":"mine/row","scalar":"double","up":"y","shapes":{)"
      R"("ground":{"type":"plane","half_space":{"normal":[0,1,0],"offset":0}}}})")};
  for (const int frame : {0, 1, 2}) {
    nlohmann::ordered_json line{{"frame", frame}, {"time", 0.1 * frame}};
    line["poses"]["ground"] = {{"position", {0, 0, 0}}, {"quat_wxyz", {1, 0, 0, 0}}};
    for (const int k : {0, 1, 2}) {
      const std::string name = "ball_" + std::to_string(k);
      lines[0]["shapes"][name] = {{"type", "sphere"}, {"radius", 1}};
      line["poses"][name] = {{"position", {3 * k, 0.99, 0}}, {"quat_wxyz", {1, 0, 0, 0}}};
      line["pairs"].push_back(
          parse(R"({"a":"ground","b":")" + name + R"(","manifolds":[{"normal":[0,1,0],"points":[)" +
                R"({"position":[)" + std::to_string(3 * k) +
                R"(,0,0],"separation":-0.01,"impulse":{"normal":1.5,"friction":[0,0,0]}}]}]})"));
    }
    lines.push_back(line);
  }
  return lines;
}

/// The text, and the JSON, of `diff` after these values of the second run were changed.
struct Compared {
  explicit Compared(const std::map<std::string, double>& changes, const std::string& more = "") {
    const TemporaryFolder folder;
    const auto text = [](const nlohmann::ordered_json& lines) {
      std::string all;
      for (const auto& line : lines) all += line.dump() + "\n";
      return all;
    };
    nlohmann::ordered_json lines = row_of_balls();
    const std::string a = folder.write("a.jsonl", text(lines));
    for (const auto& [place, value] : changes)
      lines.at(nlohmann::ordered_json::json_pointer(place)) = value;
    const std::string b = folder.write("b.jsonl", text(lines));
    const std::string command = "diff '" + a + "' '" + b + "'";
    result = run(command);
    json = nlohmann::json::parse(run(command + " --json").out);
    if (!more.empty()) drawn = run(command + " --picture '" + (folder / more) + "'");
    is_drawn = !more.empty() && std::filesystem::exists(folder / more);
  }
  ProgramRun result, drawn;
  nlohmann::json json;
  bool is_drawn = false;
};
std::string at_point(int line, int pair, const std::string& rest) {
  return "/" + std::to_string(line) + "/pairs/" + std::to_string(pair) + "/manifolds/0/points/0/" +
         rest;
}

TEST(DiffVerb, NamesThePairThatDiffersMostInTheFirstFrameThatDiffers) {
  const Compared runs({{at_point(2, 0, "impulse/normal"), 1.52},
                       {at_point(2, 1, "impulse/friction/2"), -0.035},
                       {at_point(2, 2, "impulse/normal"), 1.478},
                       {at_point(3, 0, "impulse/normal"), 7}});
  EXPECT_THAT(runs.result.out,
              HasSubstr("first in frame 1, ground-ball_1, stage: solver\n  point 0 "
                        "friction impulse (0, 0, 0) -> (0, 0, -0.035)\n  2 more "
                        "pairs differ in this frame\n"));
  EXPECT_EQ(runs.json["first"]["b"], "ball_1");
  EXPECT_EQ(runs.json["first"]["more_pairs"], 2);
  EXPECT_FALSE(runs.json.contains("header"));
}

TEST(DiffVerb, AnEarlierStageComesBeforeALargerDifference) {
  const Compared runs({{at_point(2, 0, "impulse/normal"), 9},
                       {at_point(2, 1, "position/0"), 3.001},
                       {at_point(2, 1, "impulse/normal"), 8},
                       {at_point(2, 2, "position/0"), 6.002}});
  EXPECT_THAT(runs.result.out,
              HasSubstr("first in frame 1, ground-ball_2, stage: points\n  point 0 "
                        "moved 2 mm along x\n"));
  const Compared poses({{"/2/poses/ball_0/position/1", 0.991},
                        {"/2/poses/ball_1/position/1", 0.994},
                        {at_point(2, 0, "impulse/normal"), 9}});
  EXPECT_EQ(poses.json["first"]["shape"], "ball_1");
  EXPECT_EQ(poses.json["first"]["stage"], "poses");
  EXPECT_THAT(poses.result.out, HasSubstr("  1 more pair differs in this frame\n"));
}

TEST(DiffVerb, ASettingIsNamedAndThenThePairInWhichTheRunsPart) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, int iterations, double impulse) {
    std::string text;
    for (nlohmann::ordered_json line : row_of_balls()) {
      if (line.contains("frame"))
        line["solver"] = {{"iterations", iterations}, {"bodies", nlohmann::json::object()}};
      if (line.value("frame", 0) == 2)
        line["pairs"][1]["manifolds"][0]["points"][0]["impulse"]["normal"] = impulse;
      text += line.dump() + "\n";
    }
    return folder.write(name, text);
  };
  const std::string files =
      "'" + write("a.jsonl", 10, 1.5) + "' '" + write("b.jsonl", 4, 1.7) + "'";
  const ProgramRun text = run("diff " + files);
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_THAT(
      text.out,
      testing::AllOf(HasSubstr(" first in frame 0, stage: solver\n"),
                     HasSubstr("iterations 10 -> 4\n"),
                     HasSubstr(" but for that, first in frame 2, ground-ball_1, stage: solver\n"),
                     HasSubstr("impulse 1.50 -> 1.70")));
  const auto json = nlohmann::json::parse(run("diff " + files + " --json").out);
  EXPECT_EQ(json["setting"]["frame"], 0);
  EXPECT_EQ(json["first"]["frame"], 2);
  EXPECT_EQ(json["first"]["b"], "ball_1");
}

TEST(DiffVerb, ADifferenceOfTheHeaderDoesNotHideTheFrames) {
  const Compared runs({{"/0/shapes/ball_1/radius", 1.05}, {at_point(2, 2, "separation"), -0.02}},
                      "x.png");
  EXPECT_EQ(runs.result.exit_code, 1);
  EXPECT_THAT(runs.result.out,
              HasSubstr(" in the header, ball_1, stage: setup\n  radius 1.000 -> 1.050"));
  EXPECT_THAT(runs.result.out, HasSubstr(" first in frame 1, ground-ball_2, stage: points\n"));
  EXPECT_EQ(runs.json["header"]["shape"], "ball_1");
  EXPECT_EQ(runs.json["first"]["frame"], 1);
  EXPECT_EQ(runs.drawn.exit_code, 1);
  EXPECT_TRUE(runs.is_drawn) << runs.drawn.err;
  const Compared header({{"/0/shapes/ball_1/radius", 1.05}}, "x.png");
  EXPECT_EQ(header.result.exit_code, 1);
  EXPECT_FALSE(header.json.contains("first"));
  EXPECT_THAT(header.result.out, HasSubstr("3 of 3 frames are equal"));
  EXPECT_FALSE(header.is_drawn);
  EXPECT_THAT(header.drawn.err, HasSubstr("no frame differs, so there is no picture"));
}

}  // namespace
}  // namespace contactscope::test

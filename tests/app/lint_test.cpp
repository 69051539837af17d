#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kHeader =
    R"({"schema":"contactscope.trace/1","scenario":"mine/crate","scalar":"float","up":"y","shapes":{)"
    R"("ground":{"type":"plane","vertices":[],"half_space":{"normal":[0,1,0],"offset":0}},)"
    R"("crate":{"type":"hull","vertices":[[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],)"
    R"([-1,1,1],[1,1,1]]}}})";

/// A crate 20 mm deep in the ground, with its writer's claims.
std::string crate(const std::string& normal, const std::string& separation) {
  std::string points;
  for (const char* place : {"-1,-0.02,-1", "1,-0.02,-1", "-1,-0.02,1", "1,-0.02,1"})
    points += std::string(points.empty() ? "" : ",") + R"({"position":[)" + place +
              R"(],"separation":)" + separation + "}";
  return std::string(kHeader) + "\n" +
         R"({"frame":0,"time":0,"poses":{"ground":{"position":[0,0,0],"quat_wxyz":[1,0,0,0]},)" +
         R"("crate":{"position":[0,0.98,0],"quat_wxyz":[1,0,0,0]}},"pairs":[{"a":"ground","b":"crate",)" +
         R"("manifolds":[{"normal":[)" + normal + R"(],"points":[)" + points + "]}]}]}\n";
}

TEST(LintVerb, ReportsOkForACorrectTrace) {
  const TemporaryFolder folder;
  const std::string file = folder.write("right.jsonl", crate("0,1,0", "-0.02"));
  const ProgramRun result = run("lint '" + file + "'");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("ok  " + file));
}

TEST(LintVerb, NamesTheCauseWithLineAndRemedy) {
  const TemporaryFolder folder;
  const std::string file = folder.write("flipped.jsonl", crate("0,-1,0", "-0.02"));
  const ProgramRun result = run("lint '" + file + "'");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr(file + ":2:1: normals point from b to a, 1 of 1"));
  EXPECT_THAT(result.out, HasSubstr("frame 0, ground-crate"));
  EXPECT_THAT(result.out, HasSubstr("negate each normal"));
  const ProgramRun doctor = run("doctor '" + file + "'");
  EXPECT_EQ(doctor.exit_code, 1);
  EXPECT_THAT(doctor.out, HasSubstr("normals point from b to a"));
  EXPECT_THAT(doctor.out, Not(HasSubstr("ok  trace")));
}

TEST(LintVerb, PrintsJson) {
  const TemporaryFolder folder;
  const std::string right = folder.write("right.jsonl", crate("0,1,0", "-0.02"));
  const std::string half = folder.write("half.jsonl", crate("0,1,0", "-0.01"));
  const ProgramRun result = run("lint --json '" + right + "' '" + half + "'");
  EXPECT_EQ(result.exit_code, 1);
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["schema"], "contactscope.lint/1");
  ASSERT_EQ(json["files"].size(), 2u);
  EXPECT_TRUE(json["files"][0]["findings"].empty());
  ASSERT_EQ(json["files"][1]["findings"].size(), 1u);
  const auto& finding = json["files"][1]["findings"][0];
  EXPECT_EQ(finding["cause"], "half_depths");
  EXPECT_EQ(finding["line"], 2);
  EXPECT_EQ(finding["a"], "ground");
}

TEST(LintVerb, HintsThatDifferInTheirShapesAloneAreOne) {
  const TemporaryFolder folder;
  auto header = nlohmann::ordered_json::parse(kHeader);
  nlohmann::ordered_json hull = header["shapes"]["crate"];
  hull["margin"] = 0.5;
  for (int i = 0; i < 6; ++i) header["shapes"]["rock_" + std::to_string(i)] = hull;
  const std::string trace = crate("0,1,0", "-0.02");
  const std::string file =
      folder.write("rocks.jsonl", header.dump() + trace.substr(trace.find('\n')));
  const ProgramRun grouped = run("lint '" + file + "'");
  EXPECT_EQ(grouped.exit_code, 0) << grouped.out << grouped.err;
  EXPECT_THAT(grouped.out, HasSubstr("of 'rock_0'; likewise of 'rock_1', 'rock_2', 'rock_3' and 2 "
                                     "more (--verbose) [large_margin]"));
  EXPECT_EQ(std::ranges::count(grouped.out, '\n'), 4);
  const ProgramRun whole = run("lint --verbose '" + file + "'");
  for (int i = 0; i < 6; ++i)
    EXPECT_THAT(whole.out, HasSubstr("of 'rock_" + std::to_string(i) + "' [large_margin]"));
  const auto json = nlohmann::json::parse(run("lint --json '" + file + "'").out);
  EXPECT_EQ(json["files"][0]["hints"].size(), 6u);
}

TEST(LintVerb, AMisspeltKeyOfAShapeIsWarnedOf) {
  const TemporaryFolder folder;
  auto header = nlohmann::ordered_json::parse(kHeader);
  header["shapes"]["crate"]["centerOfMass"] = {0, 0.1, 0};
  header["shapes"]["crate"]["margins"] = 0.01;
  header["shapes"]["crate"]["friction"] = 0.5;
  const std::string trace = crate("0,1,0", "-0.02");
  const std::string file =
      folder.write("spelt.jsonl", header.dump() + trace.substr(trace.find('\n')));
  const ProgramRun result = run("lint '" + file + "'");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.err,
              HasSubstr(file + ":1:1: warning: 'shapes.crate' has a key 'centerOfMass', "
                               "which is not read; did you mean 'center_of_mass'?\n"));
  EXPECT_THAT(result.err, HasSubstr("'margins', which is not read; did you mean 'margin'?"));
  EXPECT_THAT(result.err, Not(HasSubstr("friction")));
}

TEST(LintVerb, KnownAndIgnoredFindingsExitWithZero) {
  const TemporaryFolder folder;
  const std::string half = folder.write("run.jsonl", crate("0,1,0", "-0.01"));
  const std::string flipped = folder.write("next/run.jsonl", crate("0,-1,0", "-0.02"));
  const std::string known = folder / "known.json";
  EXPECT_EQ(run("lint --known '" + known + "' '" + half + "'").exit_code, 2);
  EXPECT_EQ(run("lint --write-known '" + known + "' '" + half + "'").exit_code, 0);
  const ProgramRun same = run("lint --known '" + known + "' '" + half + "'");
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_THAT(same.out, HasSubstr("1 known finding"));
  const ProgramRun next = run("lint --known '" + known + "' '" + flipped + "'");
  EXPECT_EQ(next.exit_code, 1);
  EXPECT_THAT(next.out, HasSubstr("[flipped_normals]"));
  // The findings of one trace hold for traces of any name, and have no places.
  const std::string other = folder.write("other.jsonl", crate("0,1,0", "-0.01"));
  EXPECT_EQ(run("lint --known '" + known + "' '" + other + "'").exit_code, 0);
  EXPECT_THAT(read_text(folder / "known.json"), Not(HasSubstr("marks")));
  EXPECT_EQ(run("lint --ignore half_depths '" + half + "'").exit_code, 0);
  EXPECT_EQ(run("lint --ignore half_depths:crate '" + half + "'").exit_code, 0);
  EXPECT_EQ(run("lint --ignore half_depths:crate,flipped_normals '" + half + "'").exit_code, 0);
  const ProgramRun unknown = run("lint --ignore half_depths:crat '" + half + "'");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("--ignore: there is no shape 'crat'; did you mean 'crate'? "
                                     "known: 'crate' and 'ground'"));
  EXPECT_THAT(run("render --ignore half_depths:crat '" + half + "'").err,
              HasSubstr("--ignore: there is no shape 'crat'; did you mean 'crate'?"));
  const std::string text = folder.write("known.txt", "lost pairs\n");
  EXPECT_THAT(run("lint --known '" + text + "' '" + half + "'").err,
              HasSubstr("no findings of lint can be read here (it is not JSON); write them with"));
  const std::string array = folder.write("run.json", "[\n" + crate("0,1,0", "-0.01") + "]\n");
  EXPECT_THAT(
      run("lint '" + array + "'").err,
      HasSubstr("run.json:1:1: this is a JSON array, and a trace has one JSON object a line"));
  const ProgramRun misspelled = run("lint --ignore half_depth:crate '" + half + "'");
  EXPECT_EQ(misspelled.exit_code, 2);
  EXPECT_THAT(misspelled.err, HasSubstr("did you mean 'half_depths'?"));
  EXPECT_EQ(run("lint --tolerance 0.02 '" + half + "'").exit_code, 0);
}

TEST(LintVerb, AKnownFindingIsNewWhenItIsMuchGrosser) {
  const TemporaryFolder folder;
  const std::string known = folder / "known.json";
  const auto run_known = [&](const char* separation, const std::string& option) {
    const std::string file = folder.write("run.jsonl", crate("0,1,0", separation));
    return run("lint --" + option + " '" + known + "' '" + file + "'");
  };
  EXPECT_EQ(run_known("-0.03", "write-known").exit_code, 0);
  EXPECT_EQ(run_known("-0.03", "known").exit_code, 0);
  EXPECT_EQ(run_known("-0.032", "known").exit_code, 0);
  const ProgramRun grosser = run_known("-0.22", "known");  // a tenth of the crate
  EXPECT_EQ(grosser.exit_code, 1);
  EXPECT_THAT(grosser.out, HasSubstr("[margin_added]"));
}

/// A finding below its threshold is new if it is clearly more frequent than in the file.
TEST(LintVerb, AKnownFindingBelowItsThresholdIsNewWhenItIsMoreFrequent) {
  const TemporaryFolder folder;
  const std::string known = folder / "known.json";
  // A crate at rest in 600 frames. In the last ones the reported depth creeps beyond the tolerance.
  const auto trace = [&](int wrong) {
    const std::string right = crate("0,1,0", "-0.02"), frame = right.substr(right.find('\n') + 1);
    std::string text = right.substr(0, right.find('\n') + 1);
    for (int f = 0; f < 600; ++f) {
      nlohmann::json json = nlohmann::json::parse(frame);
      json["frame"] = f, json["time"] = f / 60.0;
      const double creep = 0.0015 * std::max(0, f - 595 + wrong);
      for (auto& point : json["pairs"][0]["manifolds"][0]["points"])
        point["separation"] = -0.02 - creep;
      text += json.dump() + "\n";
    }
    return folder.write(std::to_string(wrong) + ".jsonl", text);
  };
  const ProgramRun few = run("lint --write-known '" + known + "' '" + trace(2) + "'");
  EXPECT_EQ(few.exit_code, 0);
  EXPECT_THAT(few.out, HasSubstr("below the threshold"));
  EXPECT_EQ(run("lint --known '" + known + "' '" + trace(2) + "'").exit_code, 0);
  EXPECT_EQ(run("lint --known '" + known + "' '" + trace(4) + "'").exit_code, 0);
  const ProgramRun many = run("lint --known '" + known + "' '" + trace(9) + "'");
  EXPECT_EQ(many.exit_code, 1);
  EXPECT_THAT(many.out, HasSubstr("more often than " + known + " knows it, 11 of 600"));
  // Without the file, it stays below.
  EXPECT_EQ(run("lint '" + trace(9) + "'").exit_code, 0);
}

/// With --strict each pair of a known finding counts.
TEST(LintVerb, AKnownFindingInAnotherPairIsNewWithStrict) {
  const TemporaryFolder folder;
  // Two crates on the ground in a frame; one is reported too deep.
  const auto trace = [&](int wrong) {
    const std::string text = crate("0,1,0", "-0.02");
    nlohmann::json header = nlohmann::json::parse(text.substr(0, text.find('\n')));
    nlohmann::json frame = nlohmann::json::parse(text.substr(text.find('\n')));
    header["shapes"]["second"] = header["shapes"]["crate"];
    frame["poses"]["second"] = frame["poses"]["crate"];
    frame["poses"]["second"]["position"][0] = 10;
    frame["pairs"].push_back(frame["pairs"][0]);
    frame["pairs"][1]["b"] = "second";
    for (auto& point : frame["pairs"][1]["manifolds"][0]["points"])
      point["position"][0] = point["position"][0].get<double>() + 10;
    frame["pairs"][wrong]["manifolds"][0]["points"][0]["separation"] = -0.1;
    return folder.write(std::to_string(wrong) + ".jsonl",
                        header.dump() + "\n" + frame.dump() + "\n");
  };
  const std::string first = trace(0), second = trace(1), known = folder / "known.json";
  EXPECT_EQ(run("lint --strict --write-known '" + known + "' '" + first + "'").exit_code, 0);
  EXPECT_EQ(run("lint --strict --known '" + known + "' '" + first + "'").exit_code, 0);
  EXPECT_EQ(run("lint --known '" + known + "' '" + second + "'").exit_code, 0);
  const ProgramRun strict = run("lint --strict --known '" + known + "' '" + second + "'");
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_THAT(strict.out, HasSubstr("in a pair where " + known + " has none"));
  EXPECT_THAT(strict.out, HasSubstr("ground-second"));
  const ProgramRun found = run("find --strict --known '" + known + "' '" + second + "' 'lint > 0'");
  EXPECT_EQ(found.exit_code, 0) << found.err;
  EXPECT_EQ(run("find --strict --known '" + known + "' '" + first + "' 'lint > 0'").exit_code, 1);
}

/// Findings can be ignored for a shape that is only in one of the files, or only in a later frame.
TEST(LintVerb, IgnoredShapesMayBeInAnyFileAndFrame) {
  const TemporaryFolder folder;
  const std::string half = folder.write("run.jsonl", crate("0,1,0", "-0.01"));
  const std::string shape = R"("shapes":{"late":{"type":"sphere","radius":1}},"pairs":[]})";
  const std::string other = folder.write(
      "other.jsonl", crate("0,1,0", "-0.02") +
                         R"({"frame":1,"time":1,"poses":{"late":{"position":[0,9,0],)" +
                         R"("quat_wxyz":[1,0,0,0]}},)" + shape + "\n");
  EXPECT_EQ(run("lint --ignore half_depths:late '" + half + "'").exit_code, 2);
  const ProgramRun both = run("lint --ignore half_depths:late '" + other + "' '" + half + "'");
  EXPECT_EQ(both.exit_code, 1) << both.err;
  EXPECT_THAT(both.out, HasSubstr("[half_depths]"));
}

/// Problems of single values and of the whole header come in one run.
TEST(LintVerb, AllProblemsOfAHeaderAreNamedAtOnce) {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "run.jsonl",
      R"({"schema":"contactscope.trace/1","scenario":"crate","scalar":"single","up":"Y","shapes":{)"
      R"("x":{"type":"cube","half_extents":[1,1,1]},"x_2":{"type":"hull","vertices":[[0,0,0]],)"
      R"("faces":[[0,0]]},"net":{"type":"mesh","vertices":[[0,0,0],[1,0,0],[0,1,0]]}}})"
      "\n");
  const ProgramRun result = run("lint '" + file + "'");
  EXPECT_EQ(result.exit_code, 2);
  for (const char* problem :
       {"'scalar' is 'single'; did you mean 'float'?", "'up' is 'Y'; did you mean 'y'?",
        "'shapes.x.type' is 'cube'; did you mean 'box'?", "'scenario' is 'crate'; write it as",
        "shape 'x_2' has a face of fewer than three", "shape 'net' is a mesh without 'faces'"})
    EXPECT_THAT(result.err, HasSubstr(file + ":1:1: " + problem));
  EXPECT_EQ(std::ranges::count(result.err, '\n'), 6) << result.err;
}

TEST(LintVerb, AnUnreadableTraceExitsWithTwo) {
  const TemporaryFolder folder;
  const std::string torn = folder.write("torn.jsonl", std::string(kHeader) + "\n{\"frame\":");
  EXPECT_EQ(run("lint '" + torn + "'").exit_code, 2);
  EXPECT_EQ(run("lint").exit_code, 2);
  const ProgramRun headless = run("lint '" + folder.write("a.jsonl", "{\"frame\":0}\n") + "'");
  EXPECT_EQ(headless.exit_code, 2);
  EXPECT_THAT(headless.err, HasSubstr("this is a frame, and the first line is the header"));
  EXPECT_THAT(run("lint '" + torn.substr(0, torn.rfind('/')) + "'").err,
              HasSubstr("no scenario (*.toml) in this folder; give its traces, as "));
}

/// The content before a truncated line is linted, drawn and explored, with one message about it.
TEST(LintVerb, ATornFileIsReadUpToItsLastWholeLine) {
  const TemporaryFolder folder;
  const std::string right = crate("0,1,0", "-0.02");
  const std::string frame = right.substr(right.find('\n') + 1);
  const std::string torn = folder.write("torn.jsonl", right + frame.substr(0, frame.size() / 2));
  const ProgramRun result = run("lint '" + torn + "'");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_THAT(result.out,
              HasSubstr(torn + ":3:1: the file is cut off within its last line [torn]"));
  EXPECT_THAT(result.err, testing::IsEmpty());
  const std::string out = " --size 320x180 --out '" + (folder / "out") + "'";
  for (const std::string& verb : {"render '" + torn + "'" + out, "explore --table '" + torn + "'",
                                  "find '" + torn + "' 'points > 0'"}) {
    const ProgramRun drawn = run(verb);
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_THAT(drawn.err, HasSubstr("the file is cut off here"));
    EXPECT_EQ(drawn.err.find("cut off"), drawn.err.rfind("cut off"));
  }
}

/// contactscope's own results are right, except in scenarios that show how something goes wrong.
TEST(LintVerb, SlowOnlyScenariosThatShowAFaultHaveFindings) {
  const ProgramRun result = run("lint --json scenarios");
  const auto json = nlohmann::json::parse(result.out);
  std::vector<std::string> record;
  for (const auto& file : json["files"])
    if (!file["findings"].empty() && !std::string(file["file"]).ends_with(".jsonl"))
      record.push_back(file["file"]);  // StoredTraces has those of engines
  EXPECT_GT(json["files"].size(), 100u);
  EXPECT_THAT(record,
              testing::UnorderedElementsAre(
                  "scenarios/field/plate_that_vanishes.toml",  // a field without exact cells
                  "scenarios/field/sampling_misses.toml",      // sampled too coarsely
                  "scenarios/incremental/margin.toml",         // a core too thin
                  "scenarios/incremental/rotating_out.toml",   // one point a frame
                  "scenarios/incremental/sliding.toml",        // points that slide away
                  "scenarios/mesh/sliding_over_edges.toml",    // internal edges
                  "scenarios/mesh/t_junction.toml",            // internal edges
                  "scenarios/regressions/rapier_95_ramp_of_segments.toml"));  // internal edges
}

/// Traces that engines have written, next to the scenarios.
TEST(StoredTraces, AreSmallAndLintAndPicturesSayWhatTheyShow) {
  const std::map<std::string, std::pair<std::string, std::string>> expected = {
      // the first finding of lint, and a text of the last picture
      {"bullet_car", {"separation", "1 shape has left the view"}},
      {"bullet_dolls", {"", "step_3, doll_2/1"}},
      {"bullet_explosion", {"", "4 shapes have left the view"}},
      {"bullet_twenty", {"", "worst of 48 pairs in contact"}},
      {"ode_flicker", {"pairs_flicker", "brick_3, brick_4"}},
      {"ode_pyramid", {"", "worst of 36 pairs in contact"}}};
  const auto json = nlohmann::json::parse(run("lint --json scenarios/heap").out);
  std::map<std::string, std::string> found;
  for (const auto& file : json["files"]) {
    const std::filesystem::path path = file["file"].get<std::string>();
    if (path.extension() != ".jsonl") continue;
    found[path.stem()] = file["findings"].empty() ? "" : file["findings"][0]["cause"];
    EXPECT_LT(std::filesystem::file_size(std::filesystem::path(CONTACTSCOPE_SOURCE_DIR) / path),
              100'000u)
        << path;
  }
  ASSERT_EQ(found.size(), expected.size());
  const TemporaryFolder folder;
  run("render scenarios/heap/*.jsonl --format svg --out '" + folder.path().string() + "'");
  for (const auto& [name, facts] : expected) {
    EXPECT_EQ(found[name], facts.first) << name;
    std::string last;
    for (const auto& entry : std::filesystem::directory_iterator(folder / ("heap/" + name)))
      last = std::max(last, entry.path().string());
    std::ifstream in(last);
    const std::string picture{std::istreambuf_iterator<char>(in), {}};
    EXPECT_THAT(picture, testing::HasSubstr(facts.second)) << name;
  }
}

TEST(LintPanel, NamesWhatLintNames) {
  const TemporaryFolder folder;
  const std::string out = " --format svg --out '" + folder.path().string() + "'";
  ASSERT_EQ(run("render scenarios/heap/ode_flicker.jsonl --panels lint" + out).exit_code, 0);
  const auto picture = [&](int frame) {
    std::ifstream in(folder / ("heap/ode_flicker/frame_000" + std::to_string(frame) + ".svg"));
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const auto json = nlohmann::json::parse(run("lint --json scenarios/heap/ode_flicker.jsonl").out);
  const auto& finding = json["files"][0]["findings"][0];
  std::set<int> marked;
  for (const auto& mark : finding["marks"]) marked.insert(mark["frame"].get<int>());
  ASSERT_FALSE(marked.empty());
  for (int frame = 0; frame < 8; ++frame) {
    const bool is_named = picture(frame).find("!1  brick 1 and brick 2") != std::string::npos;
    EXPECT_EQ(is_named, marked.contains(frame)) << frame;
    EXPECT_THAT(picture(frame), testing::HasSubstr("lint: 1 finding"));
  }
  const std::string strip = "render scenarios/heap/ode_flicker.jsonl --strip 3 --panels lint";
  ASSERT_EQ(run(strip + out).exit_code, 0);
  std::ifstream in(folder / "heap/ode_flicker/strip.svg");
  const std::string all{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(all, testing::HasSubstr("lint: 1 finding"));
  EXPECT_THAT(all, testing::Not(testing::HasSubstr("nothing is wrong")));
}

TEST(LintPanel, AConditionOnOnePairHasItInFocus) {
  const TemporaryFolder folder;
  const ProgramRun drawn = run(
      "render scenarios/heap/bullet_twenty.jsonl --where \"a == 'tray' and b == 'box_1'\" --format "
      "svg --out '" +
      folder.path().string() + "'");
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  std::ifstream in(folder / "heap/bullet_twenty/frame_0000.svg");
  const std::string picture{std::istreambuf_iterator<char>(in), {}};
  EXPECT_THAT(picture, HasSubstr("tray and box 1 over time"));
}

/// A shape that is recorded too large is drawn at the size that its contacts fit, too.
TEST(LintPanel, ShowsTheSizeThatContactsFit) {
  const TemporaryFolder folder;
  std::ifstream in(std::string(CONTACTSCOPE_SOURCE_DIR) + "/scenarios/heap/bullet_twenty.jsonl");
  std::string header, frames;
  std::getline(in, header);
  frames.assign(std::istreambuf_iterator<char>(in), {});
  auto json = nlohmann::ordered_json::parse(header);
  for (auto& vertex : json["shapes"]["box_1"]["vertices"])
    for (auto& coordinate : vertex) coordinate = 1.08 * coordinate.get<double>();
  const std::string file = folder.write("run.jsonl", json.dump() + "\n" + frames);
  const ProgramRun found = run("lint --frames 0:1 '" + file + "'");
  EXPECT_THAT(found.out, HasSubstr("'box_1' is 1.08 times as large as in the engine"));
  EXPECT_THAT(found.err, HasSubstr("only these frames are read"));
  const ProgramRun drawn = run("render '" + file + "' --focus worst --format svg --out '" +
                               folder.path().string() + "'");
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  std::string picture;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    if (entry.path().extension() == ".svg") {
      std::ifstream svg(entry.path());
      picture.assign(std::istreambuf_iterator<char>(svg), {});
    }
  EXPECT_THAT(picture, HasSubstr("size that the contacts fit"));
}

}  // namespace
}  // namespace contactscope::test

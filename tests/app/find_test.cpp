#include <gmock/gmock.h>

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

TEST(FindVerb, ExitCodesAndErrors) {
  const TemporaryFolder folder;
  const std::string file = folder.write("run.jsonl", crate_trace({4, 4}));
  EXPECT_EQ(run("find '" + file + "' 'points > 4'").exit_code, 1);
  EXPECT_EQ(run("render '" + file + "' --where 'points > 4' --format svg").exit_code, 1);
  const ProgramRun wrong = run("find '" + file + "' 'overlp > 5 mm'");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("column 1 of 'overlp > 5 mm': 'overlp' is not a quantity; did "
                                   "you mean 'overlap'?"));
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
}

}  // namespace
}  // namespace contactscope::test

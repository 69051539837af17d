#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;

constexpr const char* kFlippedTrace =
    R"({"schema":"contactscope.trace/1","scenario":"mine/crate","scalar":"float","up":"y","shapes":{)"
    R"("ground":{"type":"plane","vertices":[],"half_space":{"normal":[0,1,0],"offset":0}},)"
    R"("crate":{"type":"hull","vertices":[[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],)"
    R"([-1,1,1],[1,1,1]]}}})"
    "\n"
    R"({"frame":0,"time":0,"poses":{"ground":{"position":[0,0,0],"quat_wxyz":[1,0,0,0]},)"
    R"("crate":{"position":[0.123,0.98,4.56],"quat_wxyz":[1,0,0,0]}},"pairs":[{"a":"ground","b":"crate",)"
    R"("manifolds":[{"normal":[0,-1,0],"points":[{"position":[-0.877,-0.02,3.56],"separation":-0.02},)"
    R"({"position":[1.123,-0.02,3.56],"separation":-0.02}]}]}]})"
    "\n";

TEST(ShrinkVerb, WritesAScenarioAndTheClaimsOfATrace) {
  const TemporaryFolder folder;
  const std::string file = folder.write("run.jsonl", kFlippedTrace);
  const std::string out = folder.path().string();
  const ProgramRun result =
      run("shrink '" + file + "' --while lint.flipped_normals --json --out '" + out + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json["vertices"][0], 8);
  EXPECT_LE(json["vertices"][1], 4);
  const ProgramRun lint = run("lint '" + std::string(json["trace"]) + "'");
  EXPECT_EQ(lint.exit_code, 1);
  EXPECT_THAT(lint.out, HasSubstr("[flipped_normals]"));
  const ProgramRun lint_own = run("lint '" + std::string(json["scenario"]) + "'");
  EXPECT_EQ(lint_own.exit_code, 0) << lint_own.out;
}

TEST(ShrinkVerb, TakesTheTwoShapesOfASceneThatShowIt) {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  const ProgramRun result =
      run("shrink hull/edge_contact --while \"axis == 'edge_edge'\" --out '" + out + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("16 vertices -> 8"));
  const ProgramRun trace = run("trace '" + out + "/shrink/hull_edge_contact.toml'");
  EXPECT_THAT(trace.out, HasSubstr(R"("axis":"edge_edge")"));
}

TEST(ShrinkVerb, NamesWhatIsMissing) {
  const ProgramRun without = run("shrink hull/edge_contact");
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err, HasSubstr("shrink needs --while"));
  const ProgramRun wrong = run("shrink hull/edge_contact --while 'pionts > 1'");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'points'?"));
  const ProgramRun nowhere = run("shrink hull/edge_contact --while 'points > 99'");
  EXPECT_EQ(nowhere.exit_code, 1);
  EXPECT_THAT(nowhere.err, HasSubstr("in no frame of hull/edge_contact"));
  const ProgramRun engine = run("shrink hull/edge_contact --while 'nobody.points > 1'");
  EXPECT_EQ(engine.exit_code, 2);
  EXPECT_THAT(engine.err, HasSubstr("contactscope-engine-nobody"));
}

}  // namespace
}  // namespace contactscope::test

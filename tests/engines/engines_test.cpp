#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>

#include "app/program.h"

/// What engines from npm make of shapes that no engine may get wrong, and what each is known to.
namespace contactscope::test {
namespace {

using Json = nlohmann::json;

/// What each engine made of one scenario, by name.
std::map<std::string, Json> versus(const std::string& scenario, const std::string& engines) {
  const ProgramRun result = run("versus --table --json --engines " + engines + " " + scenario,
                                "PATH='" CONTACTSCOPE_SOURCE_DIR "/tests/engines':\"$PATH\"");
  std::map<std::string, Json> answers;
  const Json json = Json::parse(result.out, nullptr, false);
  if (json.is_discarded()) {
    ADD_FAILURE() << result.err;
    return answers;
  }
  for (const Json& engine : json["matches"][0]["engines"]) {
    EXPECT_FALSE(engine.contains("failure")) << engine;
    answers[engine["name"]] = engine;
  }
  return answers;
}

TEST(Engines, FindABoxOnABox) {
  const auto answers = versus("hull/eight_points_to_four --frames 0:40:4", "jolt,rapier,cannon,physx,havok");
  EXPECT_EQ(answers.size(), 5u);
  for (const auto& [name, answer] : answers) {
    SCOPED_TRACE(name);
    EXPECT_EQ(answer["pairs"], 5);
    EXPECT_EQ(answer["missed"], 0);
    EXPECT_EQ(answer["invented"], 0);
    EXPECT_LT(answer["depth_error"]["worst"], 1e-5);
    EXPECT_TRUE(answer["findings"].empty()) << answer["findings"];
  }
}

TEST(Engines, FindSpheresAndCapsules) {
  for (const char* scenario : {"round/sphere_sphere", "round/sphere_capsule"}) {
    SCOPED_TRACE(scenario);
    const auto answers = versus(scenario, "jolt,rapier,physx");
    for (const auto& [name, answer] : answers) {
      SCOPED_TRACE(name);
      EXPECT_EQ(answer["missed"], 0);
      EXPECT_LT(answer["depth_error"]["worst"], 2e-3);
    }
  }
}

TEST(Engines, FindHullsOnAMesh) {
  const auto answers = versus("mesh/hull_on_terrain", "jolt,rapier,physx,havok");
  for (const auto& [name, answer] : answers) {
    EXPECT_EQ(answer["missed"], 0) << name;
    EXPECT_GT(answer["touching"], 0) << name;
  }
}

/// Its convex radius rounds edges off: where two cross at a right angle, twice (sqrt(2) - 1) of it is lost.
TEST(Engines, JoltMissesEdgesThatItRoundsOff) {
  const Json jolt = versus("hull/edge_contact", "jolt").at("jolt");
  EXPECT_EQ(jolt["missed"], 3);
}

/// cannon-es has no capsules, and says so.
TEST(Engines, CannonHasNoCapsules) {
  const Json cannon = versus("round/sphere_capsule", "cannon").at("cannon");
  EXPECT_GT(cannon["missed"], 0);
  EXPECT_THAT(cannon["said"].get<std::string>(), testing::HasSubstr("capsule"));
}

}  // namespace
}  // namespace contactscope::test

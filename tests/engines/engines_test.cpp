#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/program.h"

/// Engines from npm on shapes that no engine may get wrong, and the known faults of each.
namespace contactscope::test {
namespace {

using Json = nlohmann::json;

/// The result of each engine for one scenario, by name; `more` are options.
std::map<std::string, Json> versus(const std::string& scenario, const std::string& engines,
                                   const std::string& more = "") {
  const ProgramRun result =
      run("versus --table --json " + more + " --engines " + engines + " " + scenario,
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
  const auto answers =
      versus("hull/eight_points_to_four --frames 0:40:4", "jolt,rapier,cannon,physx,havok");
  EXPECT_EQ(answers.size(), 5u);
  for (const auto& [name, answer] : answers) {
    SCOPED_TRACE(name);
    EXPECT_EQ(answer["pairs"], 5);
    EXPECT_EQ(answer["missed"], 0);
    EXPECT_EQ(answer["invented"], 0);
    EXPECT_LT(answer["depth_error"]["worst"], 1e-5);
    for (const Json& finding : answer["findings"])  // Rapier has a point of one frame twice
      EXPECT_TRUE(name == "rapier" && finding["cause"] == "points_twice") << finding;
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

constexpr const char* kAll = "contactscope,jolt,rapier,cannon,physx,havok";

TEST(Engines, StepAPyramid) {
  for (const auto& [name, answer] : versus("solver/pyramid", kAll, "--rollout")) {
    SCOPED_TRACE(name);
    EXPECT_EQ(answer["frames"], 300);
    EXPECT_EQ(answer["velocities"], "told");
    EXPECT_EQ(answer["fallen"], 0);
    EXPECT_LT(answer["drift"]["worst"], 0.05);
    EXPECT_LT(answer["penetration"]["worst"], 0.01);
    EXPECT_TRUE(answer["findings"].empty()) << answer["findings"];
  }
}

/// A spinning hull with oblique axes, and a box on a lid that a script raises, without gravity. The
/// initial energy checks masses, inertia and velocities; the box's gain checks the lid's speed.
TEST(Engines, ReceiveMassesVelocitiesAndScripts) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("tests/thrown.toml", R"(title = "Thrown"
[time]
frames = 31
[shapes.hull]
type     = "hull"
vertices = [[-0.3,-0.2,-0.4],[0.7,-0.1,-0.3],[-0.2,0.5,-0.5],[-0.1,0.0,0.6],[0.4,0.6,0.4]]
position = [5, 0, 0]
rotation = { axis = [1, 2, 3], degrees = 40 }
motion   = { dynamic = true, mass = 3, velocity = [1, 0.5, 0], angular_velocity = [0.2, -0.3, 0.4] }
[shapes.lid]
type         = "box"
half_extents = [0.5, 0.1, 0.5]
motion       = { velocity = [0, 1, 0] }
[shapes.rider]
type         = "box"
half_extents = [0.2, 0.2, 0.2]
position     = [0, 0.3, 0]
motion       = { dynamic = true, mass = 2 }
[world]
gravity = [0, 0, 0]
)");
  auto answers = versus("'" + scene + "'", kAll, "--rollout");
  const Json own = answers.at("contactscope");
  EXPECT_EQ(answers.size(), 6u);
  for (const auto& [name, answer] : answers) {
    SCOPED_TRACE(name);
    EXPECT_EQ(answer["frames"], 31);
    EXPECT_NEAR(answer["series"]["energy"][0], own["series"]["energy"][0], 1e-5);
    // The box gets the speed of the lid, a gain of one joule; springs throw it a little.
    const double gained =
        answer["series"]["energy"][30].get<double>() - answer["series"]["energy"][0].get<double>();
    EXPECT_GT(gained, 0.95);
    EXPECT_LT(gained, 1.65);
    EXPECT_NEAR(answer["series"]["height"][30], own["series"]["height"][30], 0.12);
  }
}

/// It has no capsules, and refuses to step rather than replacing them.
TEST(Engines, CannonStepsNoCapsules) {
  const Json cannon = versus("pipeline/mesh_and_actors", "cannon", "--rollout").at("cannon");
  EXPECT_THAT(cannon["no_rollout"].get<std::string>(), testing::HasSubstr("no capsule"));
}

/// Its convex radius rounds edges: at a right angle, twice (sqrt(2) - 1) of it is lost.
TEST(Engines, JoltMissesEdgesThatItRoundsOff) {
  const Json jolt = versus("hull/edge_contact", "jolt").at("jolt");
  EXPECT_EQ(jolt["missed"], 1);
}

/// cannon-es has no capsules and reports this.
TEST(Engines, CannonHasNoCapsules) {
  const Json cannon = versus("round/sphere_capsule", "cannon").at("cannon");
  EXPECT_GT(cannon["missed"], 0);
  EXPECT_THAT(cannon["said"].get<std::string>(), testing::HasSubstr("capsule"));
}

/// The loop around a step in the README of the recorders, with a crate that falls on the ground.
TEST(Engines, TheRecordersReadmeRecordsCannon) {
  const std::string recorders = CONTACTSCOPE_SOURCE_DIR "/src/recorder";
  const std::string readme = read_text(recorders + "/README.md");
  const std::size_t begin =
      readme.find("    const recorder = new Recorder(\"run.jsonl\", \"mine/crate\"");
  ASSERT_NE(begin, std::string::npos);
  const std::string loop = readme.substr(begin, readme.find("\n\n", begin) - begin);
  const TemporaryFolder folder;
  std::filesystem::create_directory_symlink(CONTACTSCOPE_SOURCE_DIR "/tests/engines/node_modules",
                                            folder / "node_modules");
  const std::string script = folder.write("script.mjs", R"(import * as CANNON from "cannon-es";
import { Recorder } from ")" + recorders + R"(/contactscope.mjs";
const world = new CANNON.World({ gravity: new CANNON.Vec3(0, -9.81, 0) });
const ground = new CANNON.Body({ mass: 0, shape: new CANNON.Plane() });
const crate = new CANNON.Body({ mass: 1, shape: new CANNON.Box(new CANNON.Vec3(0.5, 0.5, 0.5)) });
ground.quaternion.setFromEuler(-Math.PI / 2, 0, 0);
crate.position.set(0, 0.6, 0);
for (const body of [ground, crate]) world.addBody(body);
)" + loop + "\nfor (let i = 0; i < 120; ++i) step();\nrecorder.stop();\n");
  ASSERT_EQ(std::system(("cd '" + folder.path().string() + "' && node '" + script + "'").c_str()),
            0);
  const ProgramRun lint = run("lint --json '" + folder / "run.jsonl" + "'");
  EXPECT_EQ(lint.exit_code, 0) << lint.out << lint.err;
  const ProgramRun found = run("find '" + folder / "run.jsonl" + "' 'points >= 4' --json");
  EXPECT_EQ(found.exit_code, 0) << found.err;
}

}  // namespace
}  // namespace contactscope::test

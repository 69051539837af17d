#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/fake_engines.h"

/// `versus --rollout` with scripted programs as engines.
namespace contactscope::test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

/// A crate of 2 kg, a ground with its surface at `height`, and a lid that a script slides over it.
std::string crate_on_ground(double height) {
  return R"(title = "A crate"
[time]
frames = 40
[shapes.ground]
type     = "plane"
normal   = [0, 1, 0]
offset   = )" +
         std::to_string(height) + R"(
friction = 0.5
[shapes.crate]
type         = "box"
half_extents = [0.5, 0.25, 0.5]
position     = [0, 0.25, 0]
motion       = { dynamic = true, mass = 2 }
[shapes.lid]
type     = "sphere"
radius   = 0.1
position = [0, 3, 0]
motion   = { velocity = [1, 0, 0] }
[pipeline]
scalar = "double"
[world]
gravity     = [0, -10, 0]
restitution = 0.25
)";
}

class Rollout : public FakeEngines {
 protected:
  ProgramRun rollout(const std::string& arguments) {
    return versus("--rollout --table " + arguments);
  }
  /// The crate, stepped by each of these.
  ProgramRun step_crate(const std::string& engines) {
    return rollout("--json --engines " + engines + " '" + crate_ + "'");
  }

  std::string crate_ = folder_.write("tests/crate.toml", crate_on_ground(0));
};

TEST_F(Rollout, OurOwnCrateStands) {
  const ProgramRun result = step_crate("contactscope");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const Json own = entry(result, "contactscope");
  EXPECT_EQ(own["frames"], 40);
  EXPECT_EQ(own["resting"], 1);
  EXPECT_EQ(own["fallen"], 0);
  EXPECT_EQ(own["velocities"], "told");
  EXPECT_LT(own["drift"]["worst"], 5e-3);
  EXPECT_LT(own["penetration"]["worst"], 5e-3);
  EXPECT_NEAR(own["series"]["height"][0], 0.25, 1e-12);
  EXPECT_NEAR(own["series"]["energy"][0], 5, 1e-9);
  EXPECT_TRUE(own["findings"].empty());
}

/// The input contains everything that an engine needs.
TEST_F(Rollout, RequestHasMassesSurfacesAndScripts) {
  const std::string heard = folder_ / "heard.jsonl";
  engine("ear", "echo $1 > '" + heard + ".question'; cat > '" + heard +
                    "'; echo I only listen >&2; exit 3");
  const ProgramRun result = step_crate("ear,contactscope");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(entry(result, "ear")["no_rollout"], "I only listen");
  EXPECT_EQ(read_text(heard + ".question"), "rollout\n");
  std::istringstream lines(read_text(heard));
  std::string line;
  std::getline(lines, line);
  const Json header = Json::parse(line);
  EXPECT_EQ(header["world"]["gravity"], Json({0, -10, 0}));
  EXPECT_NEAR(header["world"]["time_step"], 1.0 / 60, 1e-15);
  EXPECT_EQ(header["frames"], 40);
  EXPECT_EQ(header["shapes"]["ground"]["friction"], 0.5);
  EXPECT_EQ(header["shapes"]["crate"]["friction"], 0.6);
  EXPECT_EQ(header["shapes"]["crate"]["restitution"], 0.25);
  std::getline(lines, line);
  const Json start = Json::parse(line);
  const Json crate = start["solver"]["bodies"]["crate"];
  EXPECT_EQ(crate["mass"], 2);
  EXPECT_NEAR(crate["inertia"][0][0], 2.0 / 12 * (0.25 + 1), 1e-12);
  EXPECT_NEAR(crate["inertia"][1][1], 2.0 / 12 * 2, 1e-12);
  EXPECT_EQ(start["poses"].size(), 3u);
  for (int k = 1; k < 40; ++k) {
    ASSERT_TRUE(std::getline(lines, line));
    const Json frame = Json::parse(line);
    ASSERT_EQ(frame["poses"].size(), 1u);
    EXPECT_NEAR(frame["poses"]["lid"]["position"][0], k / 60.0, 1e-12);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

/// All three numbers of a position, although a compiler may vectorize two of them.
TEST_F(Rollout, PosesOfAFloatScenarioAreFloats) {
  const std::string heard = folder_ / "heard.jsonl";
  engine("ear", "cat > '" + heard + "'; exit 3");
  std::string text = crate_on_ground(0);
  text.replace(text.find("\"double\""), 8, "\"float\"");
  text.replace(text.find("velocity = [1, 0, 0]"), 20, "velocity = [1, 0.7, 0.3]");
  const std::string crate = folder_.write("tests/floats.toml", text);
  EXPECT_EQ(rollout("--json --engines ear,contactscope '" + crate + "'").exit_code, 0);
  std::istringstream lines(read_text(heard));
  std::string line;
  int numbers = 0;
  for (std::getline(lines, line); std::getline(lines, line);) {
    const Json frame = Json::parse(line);
    for (const double number : frame["poses"]["lid"]["position"]) {
      EXPECT_EQ(number, static_cast<double>(static_cast<float>(number))) << line;
      ++numbers;
    }
  }
  EXPECT_EQ(numbers, 3 * 40);
}

/// The ground of this engine is 4 m lower.
TEST_F(Rollout, AnEngineInWhichTheCrateFalls) {
  const std::string falling = folder_.write("tests/falling.toml", crate_on_ground(-4));
  const std::string answer = folder_.write("answer.jsonl", run("trace '" + falling + "'").out);
  engine("hollow", "cat '" + answer + "'");
  const ProgramRun result = step_crate("contactscope,hollow");
  EXPECT_EQ(result.exit_code, 1);  // the crate rests in one engine and falls in the other
  const Json hollow = entry(result, "hollow");
  EXPECT_EQ(hollow["fallen"], 1);
  // Half of its thickness is 0.25 m: 5 t (t + dt) = 0.25.
  EXPECT_NEAR(hollow["fell"]["time"], 0.23, 0.02);
  EXPECT_EQ(hollow["fell"]["shape"], "crate");
  EXPECT_GT(hollow["penetration"]["worst"], 1.5);
  const ProgramRun table = rollout("--engines contactscope,hollow '" + crate_ + "'");
  EXPECT_THAT(table.out, HasSubstr("hollow: 'crate' is the first to fall, at 0.2"));
}

TEST_F(Rollout, EnginesThatHangOrCrashAreJudgedByTheFramesTheyGave) {
  std::string own = run("trace '" + crate_ + "'").out;
  const std::string good = folder_.write("good.jsonl", own);
  const std::size_t seventh = own.find("{\"frame\":7");
  own.replace(own.find("\"position\":[", own.find("\"crate\"", seventh)) + 12, 1, "NaN");
  const std::string bad = folder_.write("bad.jsonl", own);
  engine("hang", "head -n 6 '" + good + "'; sleep 60");
  engine("crash", "head -n 11 '" + good + "'; kill -SEGV $$");
  engine("nan", "cat '" + bad + "'");
  engine("short", "head -n 21 '" + good + "'");
  engine("blind", "cat");
  const ProgramRun result = step_crate("hang,crash,nan,short,blind,contactscope --time-limit 0.5");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const auto failure = [&](const char* name) {
    return entry(result, name)["failure"].get<std::string>();
  };
  EXPECT_THAT(failure("hang"), HasSubstr("stopped after"));
  EXPECT_EQ(entry(result, "hang")["frames"], 5);
  EXPECT_THAT(failure("crash"), HasSubstr("signal 11"));
  EXPECT_EQ(entry(result, "crash")["frames"], 10);
  EXPECT_THAT(failure("nan"), HasSubstr("nan's answer:9:"));
  EXPECT_EQ(entry(result, "nan")["frames"], 7);
  EXPECT_EQ(failure("short"), "it answered 20 of 40 frames");
  // The request has the crate only at the start.
  EXPECT_EQ(failure("blind"), "frame 1 has no pose of 'crate'");
  EXPECT_EQ(entry(result, "contactscope")["frames"], 40);
}

TEST_F(Rollout, AStaticSceneIsRefusedWithTheRemedy) {
  const ProgramRun result = rollout("--engines contactscope hull/face_contact");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("hull/face_contact.toml: no shape is dynamic"));
  EXPECT_THAT(result.err, HasSubstr("dynamic = true"));
  const std::string trace = folder_.write("run.jsonl", run("trace '" + crate_ + "'").out);
  const ProgramRun of_trace = rollout("--engines contactscope '" + trace + "'");
  EXPECT_EQ(of_trace.exit_code, 2);
  EXPECT_THAT(of_trace.err, HasSubstr("is a trace; name a scenario"));
}

}  // namespace
}  // namespace contactscope::test

#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/fake_engines.h"
#include "image/png.h"

namespace contactscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Json = nlohmann::json;

using Versus = FakeEngines;

constexpr const char* kScenario = "hull/eight_points_to_four --frames 0:8:4 --table --json";

TEST_F(Versus, OurOwnContactsAreRight) {
  const ProgramRun result = versus(std::string(kScenario) + " --engines contactscope");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const Json own = entry(result, "contactscope");
  EXPECT_EQ(own["pairs"], 3);
  EXPECT_EQ(own["missed"], 0);
  EXPECT_LT(own["depth_error"]["worst"], 1e-6);
  EXPECT_EQ(own["points"], 4);
  EXPECT_GT(own["area_ratio"], 0.5);
  EXPECT_LT(own["area_ratio"], 1);
}

/// The engine echoes its input: shapes, poses and pairs, and no contacts.
TEST_F(Versus, AnEngineThatFindsNothingMissesAll) {
  engine("blind", "cat");
  const ProgramRun result = versus(std::string(kScenario) + " --engines blind");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(entry(result, "blind")["missed"], 3);
  EXPECT_EQ(entry(result, "blind")["pairs"], 3);
}

TEST_F(Versus, EnginesThatHangCrashOrTalkNonsenseStopNoOther) {
  engine("crash", "head -c 4000; kill -SEGV $$");
  engine("hang", "sleep 60");
  engine("nonsense", "echo nonsense");
  engine("sorry", "echo no licence >&2; exit 3");
  engine("deaf", "exit 0");  // reads nothing
  const ProgramRun result =
      versus(std::string(kScenario) +
             " --time-limit 0.5 --engines crash,hang,nonsense,sorry,deaf,contactscope");
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const auto failure = [&](const char* name) {
    return entry(result, name)["failure"].get<std::string>();
  };
  EXPECT_THAT(failure("crash"), HasSubstr("signal 11"));
  EXPECT_THAT(failure("hang"), HasSubstr("stopped after"));
  EXPECT_THAT(failure("nonsense"), HasSubstr("not valid JSON"));
  EXPECT_THAT(failure("sorry"), HasSubstr("exit code 3: no licence"));
  EXPECT_THAT(failure("deaf"), HasSubstr("empty"));
  EXPECT_EQ(entry(result, "contactscope")["missed"], 0);
}

/// A program that answers half of the frames is judged on those.
TEST_F(Versus, MissingFramesAreReported) {
  engine("short", "head -n 2");
  const ProgramRun result = versus(std::string(kScenario) + " --engines short");
  EXPECT_EQ(entry(result, "short")["pairs"], 1);
  EXPECT_THAT(entry(result, "short")["failure"].get<std::string>(), HasSubstr("1 of 3 frames"));
}

/// A flipped answer with swapped shapes is named by the cause that lint finds.
TEST_F(Versus, TheFaultOfAnEngineIsNamed) {
  const std::string own = run("trace hull/eight_points_to_four --frames 0:8:4").out;
  std::string half = own;
  for (std::size_t at = 0;
       (at = half.find("\"normal\":[0.0,1.0,0.0],\"axis\"", at)) != std::string::npos; ++at)
    half.replace(at, 22, "\"normal\":[0.0,-1.0,0.0]");
  ASSERT_NE(half, own);
  engine("flipped", "cat '" + folder_.write("answer.jsonl", half) + "'");
  const ProgramRun result = versus(std::string(kScenario) + " --engines flipped");
  EXPECT_EQ(result.exit_code, 1);
  const Json flipped = entry(result, "flipped");
  ASSERT_FALSE(flipped["findings"].empty()) << result.out;
  EXPECT_EQ(flipped["findings"][0]["cause"], "flipped_normals");
  EXPECT_GT(flipped["normal_costs"], 0.1);
}

TEST_F(Versus, ATraceTakesPartWithItsOwnContacts) {
  std::string trace = run("trace hull/eight_points_to_four --frames 0").out;
  trace.insert(1, "\"engine\":\"mine\",\"version\":\"7\",");
  const std::string file = folder_.write("mine.jsonl", trace);
  const ProgramRun result = versus("'" + file + "' --table --json --engines contactscope");
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(entry(result, "mine, as recorded")["version"], "7");
  EXPECT_LT(entry(result, "contactscope")["depth_error"]["worst"], 1e-6);
}

TEST_F(Versus, WritesAPictureAFrameAndATable) {
  engine("blind", "cat");
  const ProgramRun result =
      versus("hull/eight_points_to_four --frames 0:4:4 --engines contactscope,blind");
  EXPECT_THAT(result.out, HasSubstr("engine"));
  EXPECT_THAT(result.out, HasSubstr("blind"));
  EXPECT_THAT(files_below(folder_ / "out"),
              ElementsAre("versus/hull/eight_points_to_four/frame_0000.png",
                          "versus/hull/eight_points_to_four/frame_0004.png"));
}

/// One engine breaks off and one steps nothing; the picture is still written.
TEST_F(Versus, ARolloutIsOnePicture) {
  const std::string trace = folder_.write("run.jsonl", run("trace solver/card_house").out);
  engine("short", "head -n 9 '" + trace + "'");
  engine("refuses", "echo not this >&2; exit 3");
  const ProgramRun result = versus(
      "solver/card_house --rollout --frames 20 --engines contactscope,short,refuses --size "
      "900x600");
  EXPECT_EQ(result.exit_code, 1) << result.err;  // one broke off
  EXPECT_THAT(result.out, HasSubstr("no rollout"));
  EXPECT_THAT(files_below(folder_ / "out"), ElementsAre("versus/solver/card_house/rollout.png"));
  const Image picture = read_png(folder_ / "out/versus/solver/card_house/rollout.png");
  EXPECT_EQ(picture.width, 900);
  EXPECT_EQ(picture.height, 600);
  int blue = 0, vermilion = 0;  // the crosses where one broke off, and the lines of the other
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    blue += picture.rgb[i] + 100 < picture.rgb[i + 2];
    vermilion += picture.rgb[i + 2] + 100 < picture.rgb[i];
  }
  EXPECT_GT(blue, 100);
  EXPECT_GT(vermilion, 1000);
}

TEST_F(Versus, ScenariosMayStandBehindTheEngines) {
  const ProgramRun result =
      versus("--table --json --engines contactscope hull/eight_points_to_four --frames 0:8:4");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(entry(result, "contactscope")["pairs"], 3);
}

TEST_F(Versus, AnEngineThatIsNotThereIsTrouble) {
  const ProgramRun result = versus(std::string(kScenario) + " --engines havok");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("contactscope-engine-havok"));
}

}  // namespace
}  // namespace contactscope::test

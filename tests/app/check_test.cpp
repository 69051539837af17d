#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// A scenario and a snapshot folder of its own.
class Check : public testing::Test {
 protected:
  Check() { store(small_scenario()); }

  void store(const std::string& scenario) { folder_.write("scenarios/group/idea.toml", scenario); }
  ProgramRun check(const std::string& arguments = "",
                   const std::string& environment = "CI=") const {
    return run("check --scenarios '" + (folder_ / "scenarios") + "' --snapshots '" +
                   (folder_ / "snapshots") + "' --out '" + (folder_ / "out") + "' " + arguments,
               environment);
  }
  std::set<std::string> stored() const { return files_below(folder_ / "snapshots"); }

  TemporaryFolder folder_;
};

// The small scenario with one text replaced.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = small_scenario();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST_F(Check, MissingSnapshotsAreWrittenAndFailOnce) {
  const ProgramRun first = check();
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_THAT(stored(),
              testing::ElementsAre("group/idea/frame_0000.png", "group/idea/frame_0001.png",
                                   "group/idea/trace.jsonl"));
  const ProgramRun second = check();
  EXPECT_EQ(second.exit_code, 0) << second.out;
}

TEST_F(Check, WithCiNothingIsWritten) {
  const ProgramRun result = check("", "CI=true");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(stored(), IsEmpty());
  const ProgramRun update = check("--update=all", "CI=true");
  EXPECT_EQ(update.exit_code, 1);
  EXPECT_THAT(update.err, HasSubstr("CI=true: nothing is updated"));
  EXPECT_THAT(stored(), IsEmpty());
}

TEST_F(Check, MovedShapeFailsWithASentenceAndThreePictures) {
  check();
  store(changed("0.495", "0.480"));
  const ProgramRun result = check();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("group/idea frame 0, slab-crate"));
  EXPECT_THAT(result.out, HasSubstr("separation"));
  const std::set<std::string> files = files_below(folder_ / "out");
  for (const char* kind : {"expected", "actual", "difference"}) {
    EXPECT_THAT(files,
                testing::Contains("check/group/idea/frame_0000." + std::string(kind) + ".png"));
  }
  EXPECT_THAT(files, testing::Contains("check/index.html"));
}

TEST_F(Check, UpdateRewritesWhatFailedAndThenAllIsTheSame) {
  check();
  store(changed("0.495", "0.480"));
  EXPECT_EQ(check("--update").exit_code, 0);
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(Check, ScenarioAfterABareUpdateIsAScenario) {
  check();
  store(changed("0.495", "0.480"));
  EXPECT_EQ(check("--update group/idea").exit_code, 0);
  EXPECT_EQ(check("--update=all group/idea").exit_code, 0);
  EXPECT_EQ(check("--update=some group/idea").exit_code, 2);
}

TEST_F(Check, UnmetExpectationFailsThoughTheSnapshotAgrees) {
  store(small_scenario() +
        "[[expect]]\na = \"slab\"\nb = \"crate\"\nstate = \"touching\"\npoints = 3\n");
  check();
  const ProgramRun result = check();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("frames 0 to 1, slab-crate: expected 3 points, got 4\n"));
}

TEST_F(Check, MissingFileAndTornFileAreCaught) {
  check();
  std::filesystem::remove(folder_ / "snapshots/group/idea/frame_0001.png");
  EXPECT_EQ(check("", "CI=true").exit_code, 1);
  check();
  folder_.write("snapshots/group/idea/frame_0001.png", "torn");
  EXPECT_EQ(check("", "CI=true").exit_code, 1);
  check("--update");
  std::filesystem::remove(folder_ / "snapshots/group/idea/trace.jsonl");
  EXPECT_EQ(check("", "CI=true").exit_code, 1);
}

TEST_F(Check, ChangedDigitInTheStoredTraceIsCaught) {
  check();
  const std::string path = folder_ / "snapshots/group/idea/trace.jsonl";
  std::string text = read_text(path);
  const std::size_t at = text.find("\"separation\":-0.00");
  ASSERT_NE(at, std::string::npos) << text;
  text[at + 18] = '8';  // 5 mm become 8 mm
  folder_.write("snapshots/group/idea/trace.jsonl", text);
  const ProgramRun result = check("", "CI=true");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("separation"));
}

TEST_F(Check, SnapshotsOfAScenarioThatIsGoneAreStale) {
  check();
  std::filesystem::rename(folder_ / "scenarios/group/idea.toml",
                          folder_ / "scenarios/group/other.toml");
  const ProgramRun result = check("", "CI=true");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("group/idea"));
}

TEST_F(Check, JsonIsOneObjectAScenario) {
  check();
  const ProgramRun result = check("--json");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr(R"({"scenario":"group/idea","same":true,"pictures":2)"));
}

TEST_F(Check, QuietPrintsNothingWhenAllIsTheSame) {
  check();
  const ProgramRun result = check("--quiet");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, IsEmpty());
}

}  // namespace
}  // namespace contactscope::test

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

TEST_F(Check, NothingIsWrittenByDefault) {
  std::filesystem::create_directory(folder_ / "snapshots");
  const ProgramRun first = check();
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_EQ(first.out, "new         group/idea: new, nothing is stored for group/idea\n");
  EXPECT_THAT(first.err, HasSubstr("check --write-missing stores what is not there yet"));
  EXPECT_THAT(stored(), IsEmpty());
  const ProgramRun written = check("--write-missing");
  EXPECT_EQ(written.exit_code, 0);
  EXPECT_THAT(written.out, HasSubstr("stored      group/idea, 3 files\n"));
  EXPECT_THAT(stored(),
              testing::ElementsAre("group/idea/frame_0000.png", "group/idea/frame_0001.png",
                                   "group/idea/trace.jsonl"));
  const ProgramRun second = check();
  EXPECT_EQ(second.exit_code, 0) << second.out;
  EXPECT_THAT(second.err, HasSubstr("1 scenario: all the same"));
}

TEST_F(Check, AFolderThatIsNotThereIsNamedAsOne) {
  const ProgramRun result = check();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr((folder_ / "snapshots") + ": no such folder of snapshots"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "snapshots"));
}

TEST_F(Check, CiWritesNothing) {
  std::filesystem::create_directory(folder_ / "snapshots");
  const ProgramRun result = check("", "CI=true");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(stored(), IsEmpty());
  const ProgramRun update = check("--update=all", "CI=true");
  EXPECT_EQ(update.exit_code, 1);
  EXPECT_THAT(update.err, HasSubstr("CI=true: nothing is written"));
  EXPECT_THAT(stored(), IsEmpty());
}

TEST_F(Check, FactsOnlyNeedsNoOpenGl) {
  check("--update");
  const std::string no_driver =
      "CI= CONTACTSCOPE_BACKEND=egl __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent";
  const ProgramRun refused = check("", no_driver);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("contactscope check --facts-only"));
  EXPECT_EQ(check("--facts-only", no_driver).exit_code, 0);
  store(changed("0.495", "0.480"));
  const ProgramRun result = check("--facts-only --verbose");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("separation"));
  EXPECT_THAT(result.err, Not(HasSubstr("OpenGL")));
}

TEST_F(Check, EveryKindComesOutOfOneRun) {
  folder_.write("scenarios/group/gone.toml", small_scenario());
  folder_.write("scenarios/group/torn.toml", small_scenario());
  folder_.write("scenarios/group/lost.toml", small_scenario());
  check("--update");
  std::filesystem::remove(folder_ / "scenarios/group/gone.toml");
  std::filesystem::remove(folder_ / "snapshots/group/lost/frame_0001.png");
  folder_.write("snapshots/group/torn/frame_0001.png", "torn");
  folder_.write("scenarios/group/young.toml", small_scenario());
  store(changed("0.495", "0.480") +
        "[[expect]]\na = \"slab\"\nb = \"crate\"\nstate = \"touching\"\npoints = 3\n");
  const ProgramRun result = check();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("4 scenarios: 0 the same, 4 fail, 1 more stored without a file "
                                    "(3 changed, 3 new, 1 missing, 3 orphaned, 1 unmet "
                                    "expectation, 1 unreadable, 0 known bad)"));
}

TEST_F(Check, OneOfTwoPicturesIsAccepted) {
  check("--update");
  store(changed("0.495", "0.480"));
  check();
  EXPECT_EQ(check("--accept group/idea/frame_0001 group/idea/trace").exit_code, 0);
  const ProgramRun after = check();
  EXPECT_EQ(after.exit_code, 1);
  EXPECT_THAT(after.err, HasSubstr("(1 changed,"));
  EXPECT_THAT(after.out, HasSubstr("group/idea frame 0: picture differs"));
  EXPECT_EQ(check("--accept group/idea", "CI=true").exit_code, 2);
  EXPECT_EQ(check("--accept '*'").exit_code, 0);
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(Check, AcceptRefusesNamesNotInTheReport) {
  check("--update");
  store(changed("0.495", "0.480"));
  check();
  const ProgramRun result = check("--accept group/idea/frame_0002");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("did you mean group/idea/frame_000"));
  EXPECT_EQ(check("--accept").exit_code, 2);
}

TEST_F(Check, MovedShapeFailsWithASentenceAndThreePictures) {
  check("--update");
  store(changed("0.495", "0.480"));
  EXPECT_THAT(check().out, HasSubstr("group/idea frame 0, crate: moved 15 mm along -y; so "));
  const ProgramRun result = check("--verbose");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("group/idea frame 0, slab-crate"));
  EXPECT_THAT(result.out, HasSubstr("separation"));
  const std::set<std::string> files = files_below(folder_ / "out");
  for (const char* kind : {"expected", "actual", "difference"}) {
    EXPECT_THAT(files,
                testing::Contains("check/group/idea/frame_0000." + std::string(kind) + ".png"));
  }
  EXPECT_THAT(files, testing::Contains("check/findings.json"));
}

TEST_F(Check, UpdateRewritesWhatFailedAndThenAllIsTheSame) {
  check("--update");
  store(changed("0.495", "0.480"));
  EXPECT_EQ(check("--update").exit_code, 0);
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(Check, ScenarioAfterABareUpdateIsAScenario) {
  check("--update");
  store(changed("0.495", "0.480"));
  EXPECT_EQ(check("--update group/idea").exit_code, 0);
  EXPECT_EQ(check("--update=all group/idea").exit_code, 0);
  EXPECT_EQ(check("--update=some group/idea").exit_code, 2);
}

TEST_F(Check, UnmetExpectationFailsThoughTheSnapshotAgrees) {
  store(small_scenario() +
        "[[expect]]\na = \"slab\"\nb = \"crate\"\nstate = \"touching\"\npoints = 3\n");
  check("--update");
  const ProgramRun result = check();
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("frames 0 to 1, slab-crate: expected 3 points, got 4\n"));
  EXPECT_THAT(result.err, HasSubstr("mend the expectation in its scenario, or what fails it"));
  EXPECT_THAT(result.err, testing::Not(HasSubstr("--accept"))) << "there is nothing to accept";
}

TEST_F(Check, MissingFileAndTornFileAreCaught) {
  check("--update");
  std::filesystem::remove(folder_ / "snapshots/group/idea/frame_0001.png");
  EXPECT_EQ(check("", "CI=true").exit_code, 1);
  check("--update");
  folder_.write("snapshots/group/idea/frame_0001.png", "torn");
  EXPECT_EQ(check("", "CI=true").exit_code, 1);
  check("--update");
  std::filesystem::remove(folder_ / "snapshots/group/idea/trace.jsonl");
  EXPECT_EQ(check("", "CI=true").exit_code, 1);
}

TEST_F(Check, ChangedDigitInTheStoredTraceIsCaught) {
  check("--update");
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
  check("--update");
  std::filesystem::rename(folder_ / "scenarios/group/idea.toml",
                          folder_ / "scenarios/group/other.toml");
  const ProgramRun result = check("", "CI=true");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("group/idea"));
  check("--junit '" + (folder_ / "junit.xml") + "'");
  EXPECT_THAT(read_text(folder_ / "junit.xml"), HasSubstr("name=\"idea\">")) << "no file is told";
}

TEST_F(Check, LimitsOfAPictureAreReportedIfItsScenarioSetsThem) {
  const auto with_limits = [](std::string scenario) {
    return scenario.insert(scenario.find("[snapshots]\n") + 12, "limits = { total = 60 }\n");
  };
  store(with_limits(small_scenario()));
  check("--update");
  store(with_limits(changed("0.495", "0.480")));
  EXPECT_THAT(check().out, HasSubstr("allowed: 60 pixels"));
  store(changed("0.495", "0.480"));
  EXPECT_THAT(check().out, Not(HasSubstr("allowed: ")));
}

TEST_F(Check, JsonMatchesTheReport) {
  check("--update");
  const ProgramRun result = check("--json");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, read_text(folder_ / "out/check/findings.json"));
  EXPECT_THAT(result.out, HasSubstr("\"schema\": \"contactscope.check/1\""));
}

TEST_F(Check, QuietPrintsNothingWhenAllIsTheSame) {
  check("--update");
  const ProgramRun result = check("--quiet");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, IsEmpty());
}

int lines_with(const std::string& text, const std::string& words) {
  int count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
    ++count;
  return count;
}

TEST(CheckOfWhatIsWithinRounding, IsOneLineOrAllOfThem) {
  const TemporaryFolder folder;
  const std::string check = "check classes/four_classes coplanar/never_empty --facts-only --out '" +
                            (folder / "out") + "' ";
  const ProgramRun one = run(check);
  EXPECT_THAT(one.err, HasSubstr("4 decisions in 2 scenarios are within rounding"));
  EXPECT_EQ(lines_with(one.out + one.err, "within rounding"), 1);
  EXPECT_EQ(lines_with(run(check + "--verbose").err, "which is within rounding"), 4);
}

}  // namespace
}  // namespace contactscope::test

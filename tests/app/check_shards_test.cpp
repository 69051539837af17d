#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "image/sha256.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Three scenarios; one was changed after it was stored.
class CheckShards : public testing::Test {
 protected:
  CheckShards() {
    for (const char* name : {"one", "two", "three"})
      folder_.write(std::string("scenarios/group/") + name + ".toml", small_scenario());
    EXPECT_EQ(check("--update").exit_code, 0);
    std::string moved = small_scenario();
    moved.replace(moved.find("0.495"), 5, "0.480");
    folder_.write("scenarios/group/two.toml", moved);
  }

  ProgramRun check(const std::string& arguments = "",
                   const std::string& environment = "CI=", const std::string& out = "out") const {
    return run("check --scenarios '" + (folder_ / "scenarios") + "' --snapshots '" +
                   (folder_ / "snapshots") + "' --out '" + (folder_ / out) + "' " + arguments,
               environment);
  }
  ProgramRun merge(const std::string& arguments = "") const {
    return run("merge '" + (folder_ / "out") + "' --out '" + (folder_ / "out") + "' " + arguments);
  }
  /// The report without times.
  std::map<std::string, std::string> report() const {
    std::map<std::string, std::string> files;
    for (const std::string& file : files_below(folder_ / "out/check"))
      if (!file.starts_with("times")) files[file] = read_text(folder_ / ("out/check/" + file));
    return files;
  }

  TemporaryFolder folder_;
};

TEST_F(CheckShards, MergedTheyAreTheReportOfOneRun) {
  EXPECT_EQ(check().exit_code, 1);
  const auto whole = report();
  EXPECT_TRUE(whole.contains("group/two/frame_0000.actual.png"));
  std::filesystem::remove_all(folder_ / "out/check");
  int failed = 0;
  for (const char* part : {"2/2", "1/2"}) failed += check(std::string("--shard ") + part).exit_code;
  EXPECT_EQ(failed, 1) << "one of them has the scenario that was moved";
  const ProgramRun merged = merge();
  EXPECT_EQ(merged.exit_code, 1);
  EXPECT_THAT(merged.err, HasSubstr("3 scenarios: 2 the same, 1 fails"));
  EXPECT_EQ(report(), whole);
  EXPECT_EQ(check("--accept group/two").exit_code, 0) << "a merged report is one to accept from";
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(CheckShards, AMissingShardIsNamed) {
  check("--shard 1/3");
  check("--shard 3/3");
  const ProgramRun merged = merge();
  EXPECT_EQ(merged.exit_code, 2);
  EXPECT_THAT(merged.err, HasSubstr("shard 2 of 3 is missing"));
  EXPECT_EQ(check("--shard 4/3").exit_code, 2);
  EXPECT_EQ(check("--shard two").exit_code, 2);
}

TEST_F(CheckShards, AShardThatIsThereTwiceIsNamed) {
  check("--shard 1/2");
  check("--shard 2/2");
  std::filesystem::copy(folder_ / "out/check_1_of_2", folder_ / "out/check_copy");
  EXPECT_THAT(merge().err, HasSubstr("shard 1 of 2 is there twice"));
}

TEST_F(CheckShards, ShardsOfDifferentRunsAreRefused) {
  check("--shard 1/2");
  check("--shard 2/2 --facts-only");
  EXPECT_THAT(merge().err, HasSubstr("not parts of one"));
}

TEST_F(CheckShards, OneThatIsLeftFromAnEarlierRunIsRefused) {
  check("--shard 1/2");
  check("--shard 2/2");
  EXPECT_EQ(merge().exit_code, 1);
  folder_.write("scenarios/group/one.toml", small_scenario() + "# another comment\n");
  check("--shard 1/2");
  const ProgramRun merged = merge();
  EXPECT_EQ(merged.exit_code, 2);
  EXPECT_THAT(merged.err, HasSubstr("is from an earlier run; run its shard again"));
  check("--shard 2/2");
  EXPECT_EQ(merge().exit_code, 1);
}

TEST_F(CheckShards, EveryCheckRunsAllScenarios) {
  check();
  EXPECT_EQ(check("--fresh").exit_code, 1);
  EXPECT_EQ(check("--accept '*'").exit_code, 0);
  EXPECT_THAT(check("--verbose").out, HasSubstr("same        group/one\n"));
  const std::string stored = folder_ / "snapshots/group/one/trace.jsonl";
  std::string text = read_text(stored);
  text[text.find("-0.00") + 4] = '9';
  folder_.write("snapshots/group/one/trace.jsonl", text);
  EXPECT_EQ(check().exit_code, 1) << "a stored digit";
  const auto times = nlohmann::json::parse(read_text(folder_ / "out/check/times.json"));
  EXPECT_EQ(times.size(), 3u);
}

TEST_F(CheckShards, TheirReportsNameTheProgram) {
  // sha256sum hashes the program and its result independently.
  const std::string listed = folder_ / "notes.txt";
  const std::string sum = "sha256sum < '" CONTACTSCOPE_BINARY_DIR "/contactscope' > ";
  ASSERT_EQ(std::system((sum + "'" + listed + "'").c_str()), 0);
  std::string made_of = read_text(listed).substr(0, 64);
  for (const char* name : {"one", "three", "two"})
    made_of += std::string("\ngroup/") + name + " " +
               sha256(read_text(folder_ / ("scenarios/group/" + std::string(name) + ".toml")));
  check("--shard 1/2 --facts-only");
  const auto report = nlohmann::json::parse(read_text(folder_ / "out/check_1_of_2/findings.json"));
  EXPECT_EQ(report.at("made_of"), sha256(made_of));
}

TEST_F(CheckShards, SeveralProcessesWithOneFolderDoNotHarmEachOther) {
  std::vector<std::future<ProgramRun>> runs;
  for (const char* name : {"group/one", "group/two", "group/three", "group/two"})
    runs.push_back(std::async(std::launch::async, [this, name] { return check(name); }));
  std::vector<int> codes;
  for (std::future<ProgramRun>& one : runs) codes.push_back(one.get().exit_code);
  EXPECT_THAT(codes, testing::ElementsAre(0, 1, 0, 1));
  const auto left = nlohmann::json::parse(read_text(folder_ / "out/check/findings.json"));
  ASSERT_EQ(left.at("scenarios").size(), 1u);
  const bool is_two = left.at("scenarios")[0].at("scenario") == "group/two";
  EXPECT_EQ(report().contains("group/two/frame_0000.actual.png"), is_two);
}

TEST_F(CheckShards, CtrlCExitsWith130) {
  const ProgramRun result = run("check --fresh --out '" + (folder_ / "out") + "'",
                                "timeout -s INT --preserve-status 0.2");
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
}

TEST_F(CheckShards, LimitsOfAViewAreTakenFromItsScenario) {
  const std::string limits = "limits = { cluster = 100000, total = 100000 }\n";
  std::string moved = read_text(folder_ / "scenarios/group/two.toml");
  folder_.write("scenarios/group/two.toml", moved + limits);
  const ProgramRun loose = check("group/two");
  EXPECT_THAT(loose.err, HasSubstr("(1 changed,")) << "the trace alone";
  folder_.write("scenarios/group/two.toml", moved + "limits = { total = 7 }\n");
  EXPECT_THAT(check("group/two --verbose").out, HasSubstr("allowed: 7 pixels"));
  folder_.write("scenarios/group/two.toml", moved + "view_limits = { side = { total = 7 } }\n");
  EXPECT_THAT(check("group/two").out, HasSubstr("'side' is not a view"));
}

TEST(Help, IsAVerbToo) {
  EXPECT_EQ(run("help check").out, run("check --help").out);
  EXPECT_EQ(run("help").out, run("--help").out);
  EXPECT_THAT(run("help").out, HasSubstr("130 stopped by Ctrl-C"));
  EXPECT_THAT(run("help check").out, HasSubstr("Examples:"));
  EXPECT_EQ(run("help nothing").exit_code, 2);
}

}  // namespace
}  // namespace contactscope::test

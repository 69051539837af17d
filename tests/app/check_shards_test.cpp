#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <nlohmann/json.hpp>

#include "app/program.h"

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
  /// Every file of the report.
  std::map<std::string, std::string> report() const {
    std::map<std::string, std::string> files;
    for (const std::string& file : files_below(folder_ / "out/check"))
      files[file] = read_text(folder_ / ("out/check/" + file));
    return files;
  }

  TemporaryFolder folder_;
};

TEST_F(CheckShards, TogetherTheyHaveTheFindingsOfOneRun) {
  using nlohmann::json;
  EXPECT_EQ(check().exit_code, 1);
  const auto findings = [&](const std::string& report) {
    return json::parse(read_text(folder_ / ("out/" + report + "/findings.json")));
  };
  json expected = findings("check").at("scenarios"), joined = json::array();
  EXPECT_EQ(expected.size(), 3u);
  int failed = 0, parts_with_picture = 0;
  for (const std::string part : {"1", "2"}) {
    failed += check("--shard " + part + "/2").exit_code;
    const std::string own = "check_" + part + "_of_2";
    const json found = findings(own);
    EXPECT_EQ(found.at("shard"), json({{"part", part[0] - '0'}, {"of", 2}}));
    for (const json& scenario : found.at("scenarios")) joined.push_back(scenario);
    parts_with_picture +=
        std::filesystem::exists(folder_ / ("out/" + own + "/group/two/frame_0000.actual.png"));
  }
  EXPECT_EQ(failed, 1) << "one of them has the scenario that was moved";
  EXPECT_EQ(parts_with_picture, 1);
  std::sort(joined.begin(), joined.end(),
            [](const json& a, const json& b) { return a.at("scenario") < b.at("scenario"); });
  EXPECT_EQ(joined, expected);
  for (const char* part : {"1/2", "2/2"}) check(std::string("--accept '*' --shard ") + part);
  EXPECT_EQ(check().exit_code, 0) << "each part's report is one to accept from";
}

TEST_F(CheckShards, PartsThatDoNotExistAreRefused) {
  EXPECT_EQ(check("--shard 4/3").exit_code, 2);
  EXPECT_EQ(check("--shard two").exit_code, 2);
}

TEST_F(CheckShards, EveryCheckRunsAllScenarios) {
  check();
  EXPECT_EQ(check().exit_code, 1);
  EXPECT_EQ(check("--accept '*'").exit_code, 0);
  EXPECT_THAT(check("--verbose").out, HasSubstr("same        group/one\n"));
  const std::string stored = folder_ / "snapshots/group/one/trace.jsonl";
  std::string text = read_text(stored);
  text[text.find("-0.00") + 4] = '9';
  folder_.write("snapshots/group/one/trace.jsonl", text);
  EXPECT_EQ(check().exit_code, 1) << "a stored digit";
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
  const ProgramRun result =
      run("check --out '" + (folder_ / "out") + "'", "timeout -s INT --preserve-status 0.2");
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

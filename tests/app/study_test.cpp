#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::vector<nlohmann::json> json_lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<nlohmann::json> list;
  for (std::string line; std::getline(in, line);) list.push_back(nlohmann::json::parse(line));
  return list;
}

TEST(Study, WritesJsonAndCsvForEachMeasureAndOpensNoOpenGlForATable) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("study reducers --cases 20 --table --verbose --out '" + (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr("left out: plots and OpenGL"));
  EXPECT_THAT(result.err, Not(HasSubstr("OpenGL through")));
  EXPECT_THAT(
      files_below(folder / "out"),
      ElementsAre("study/reducers/results.csv", "study/reducers/results.json",
                  "study/reducers/results_wrench.csv", "study/reducers/results_wrench.json"));
  const auto json = nlohmann::json::parse(read_text(folder / "out/study/reducers/results.json"));
  EXPECT_EQ(json["schema"], "contactscope.study/1");
  EXPECT_EQ(json["study"], "reducers");
  EXPECT_THAT(json["error"].get<std::string>(), HasSubstr("area"));
  for (const auto& series : json["series"]) {
    ASSERT_EQ(series["points"].size(), 6u) << series["method"];
    for (const auto& point : series["points"]) EXPECT_EQ(point["of"], 20) << series["method"];
  }
  EXPECT_THAT(read_text(folder / "out/study/reducers/results_wrench.csv"),
              StartsWith("study,measure,method,parameter,error,"));
}

TEST(Study, JsonPrintsTheResultsOneALineAndQuietSilencesTheRest) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("study reducers --cases 10 --table --json --quiet --out '" + (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  const std::vector<nlohmann::json> lines = json_lines(result.out);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["measure"], "area");
  EXPECT_EQ(lines[1]["measure"], "wrench");
  EXPECT_EQ(lines[1],
            nlohmann::json::parse(read_text(folder / "out/study/reducers/results_wrench.json")));
}

TEST(Study, SeedChoosesTheCases) {
  const TemporaryFolder folder;
  const auto errors = [&](const std::string& seed) {
    const ProgramRun result = run("study reducers --cases 10 --table --json --quiet --seed " +
                                  seed + " --out '" + (folder / "out") + "'");
    std::vector<double> list;
    const std::vector<nlohmann::json> results = json_lines(result.out);
    for (const auto& series : results.at(0)["series"]) {
      for (const auto& point : series["points"]) {
        if (!point["error"].is_null()) list.push_back(point["error"].get<double>());
      }
    }
    return list;
  };
  const std::vector<double> first = errors("5");
  EXPECT_THAT(first, Not(IsEmpty()));
  EXPECT_EQ(errors("5"), first);
  EXPECT_NE(errors("6"), first);
}

TEST(Study, UnknownNameIsTroubleAndListsTheStudies) {
  const TemporaryFolder folder;
  const ProgramRun result = run("study flight --out '" + (folder / "out") + "'");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr("reducers, hull_precision"));
  EXPECT_THAT(files_below(folder / "out"), IsEmpty());
}

TEST(Study, UsageErrorsAreTrouble) {
  for (const char* arguments :
       {"study", "study reducers --cases 0", "study reducers --seed x", "study reducers --size 5",
        "study reducers --backend vulkan", "study reducers --out ''"}) {
    const ProgramRun result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.out, IsEmpty()) << arguments;
  }
}

TEST(Study, UnwritableFolderIsTroubleAndNamed) {
  const ProgramRun result = run("study reducers --cases 5 --table --out /proc/nowhere");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("/proc/nowhere"));
}

TEST(List, NamesTheStudies) {
  const ProgramRun result = run("list studies");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, StartsWith("reducers"));
}

}  // namespace
}  // namespace contactscope::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/cli/table.h"
#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::ContainsRegex;
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
  EXPECT_THAT(result.err, HasSubstr("left out: plots and OpenGL"));
  EXPECT_THAT(result.err, Not(HasSubstr("OpenGL through")));
  EXPECT_THAT(
      files_below(folder / "out"),
      ElementsAre("study/reducers/results.csv", "study/reducers/results.json",
                  "study/reducers/results_deepest.csv", "study/reducers/results_deepest.json",
                  "study/reducers/results_flat.csv", "study/reducers/results_flat.json",
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

/// The tables on standard output: a heading and rows of cells each, separated by an empty line.
std::vector<std::vector<std::string>> tables_of(const std::string& text) {
  std::vector<std::vector<std::string>> tables(1);
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) {
      tables.emplace_back();
    } else {
      tables.back().push_back(line);
    }
  }
  return tables;
}

TEST(Study, PrintsATableForEachMeasureAndOneOfTimes) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("study reducers --cases 20 --table --quiet --out '" + (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  const std::vector<std::vector<std::string>> tables = tables_of(result.out);
  ASSERT_EQ(tables.size(), 5u);
  EXPECT_THAT(tables[0][0], StartsWith("lost area, 1 − area / best: mean / worst, by points"));
  EXPECT_THAT(tables[1][0], StartsWith("lost moment arm"));
  EXPECT_THAT(tables[2][0], StartsWith("share of the patches whose deepest point is lost: mean, "));
  EXPECT_THAT(tables[3][0], StartsWith("lost area of equally deep points"));
  EXPECT_THAT(tables[4][0], StartsWith("nanoseconds per call: median / minimum, by points"));
  const auto json = nlohmann::json::parse(read_text(folder / "out/study/reducers/results.json"));
  for (const std::vector<std::string>& table : tables) {
    ASSERT_EQ(table.size(), 2 + json["series"].size());
    EXPECT_THAT(table[1], testing::ContainsRegex("^method +5 +6 +8 +12 +16 +32"));
    for (std::size_t i = 1; i < table.size(); ++i) {
      EXPECT_EQ(table[i].size(), table[1].size()) << table[i];
      if (i < 2) continue;
      const std::string method = json["series"][i - 2]["method"];
      EXPECT_THAT(table[i], StartsWith(method + " "));
    }
  }
  // A number of the table equals that of the file.
  const auto& first = json["series"][0]["points"][0];
  char error[32];
  std::snprintf(error, sizeof error, "%.2g / ", first["error"].get<double>());
  EXPECT_THAT(tables[0][2], HasSubstr(std::string("  ") + error));
}

TEST(Study, MethodsWithOtherParametersHaveATableOfTheirOwn) {
  trace::Study result;
  result.error = "depth";
  result.parameter = "effort";
  result.series = {{"few", {{1, 0.5, {}, {}, 0, 10}}},
                   {"many", {{2, 0.25, {}, {}, 0, 10}, {4, 0.125, {}, {}, 3, 10}}}};
  std::ostringstream out;
  app::print_tables({result}, out);
  EXPECT_THAT(out.str(), ContainsRegex("method +1 +failed\nfew +0.5 +0\n"));
  EXPECT_THAT(out.str(), ContainsRegex("method +2 +4 +failed\nmany +0.25 +0.12 +3\n"));
}

TEST(Study, JsonPrintsTheResultsOneALineAndQuietSilencesTheRest) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("study reducers --cases 10 --table --json --quiet --out '" + (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  const std::vector<nlohmann::json> lines = json_lines(result.out);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0]["measure"], "area");
  EXPECT_EQ(lines[1]["measure"], "wrench");
  EXPECT_EQ(lines[2]["measure"], "deepest");
  EXPECT_EQ(lines[3]["measure"], "flat");
  EXPECT_EQ(lines[1],
            nlohmann::json::parse(read_text(folder / "out/study/reducers/results_wrench.json")));
}

TEST(Study, SlowSeedChoosesTheCases) {
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
  EXPECT_THAT(result.err, HasSubstr("'reducers', 'hull_precision'"));
  EXPECT_THAT(files_below(folder / "out"), IsEmpty());
}

TEST(Study, UsageErrorsAreTrouble) {
  for (const char* arguments :
       {"study", "study reducers --cases 0", "study reducers --cases 1000001",
        "study reducers --seed x", "study reducers --size 5", "study reducers --backend vulkan",
        "study reducers --out ''"}) {
    const ProgramRun result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.out, IsEmpty()) << arguments;
  }
}

TEST(Study, CtrlCExitsWith130AndLeavesNoFile) {
  const TemporaryFolder folder;
  const ProgramRun result = run("study stability --cases 100 --out '" + (folder / "out") + "'",
                                "timeout -s INT --preserve-status 0.5");
  EXPECT_EQ(result.exit_code, 130);
  EXPECT_THAT(files_below(folder / "out"), IsEmpty());
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

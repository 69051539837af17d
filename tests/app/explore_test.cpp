#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/program.h"
#include "reduce/reducer.h"

namespace contactscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> list;
  for (std::string line; std::getline(in, line);) list.push_back(line);
  return list;
}

/// The first column of a table below its head.
std::vector<std::string> rows_of(const std::string& table) {
  std::vector<std::string> names;
  for (const std::string& line : lines_of(table)) names.push_back(line.substr(0, line.find(' ')));
  if (!names.empty()) names.erase(names.begin());
  return names;
}

TEST(ExploreVerb, TableHasARowForEachReducerAndWritesNothing) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("explore hull/eight_points_to_four --table --verbose --out '" + (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::vector<std::string> listed;
  for (const ReducerInfo& info : reducers()) {
    if (info.name != "none") listed.push_back(info.name);
  }
  EXPECT_THAT(rows_of(result.out), testing::UnorderedElementsAreArray(listed));
  const std::vector<std::string> lines = lines_of(result.out);
  EXPECT_THAT(lines.at(0), StartsWith("reducer "));
  for (const char* head :
       {"area %", "lost arm % of radius", "deepest kept %", "ids changed", "upper quartile"}) {
    EXPECT_THAT(lines[0], HasSubstr(head));
  }
  for (const std::string& line : lines) EXPECT_EQ(line.size(), lines[0].size()) << line;
  EXPECT_THAT(result.err, HasSubstr("left out: pictures and OpenGL"));
  EXPECT_THAT(result.err, Not(HasSubstr("OpenGL through")));
  EXPECT_THAT(files_below(folder / "out"), IsEmpty());
}

TEST(ExploreVerb, TableWorksWhereEveryRouteToOpenGlIsBroken) {
  const TemporaryFolder folder;
  for (const char* library : {"libEGL.so.1", "libOSMesa.so.8"}) {
    folder.write(library, "no library\n");
  }
  const ProgramRun result = run("explore hull/eight_points_to_four --frames 0 --table",
                                "LD_LIBRARY_PATH='" + folder.path().string() + "'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("reducer "));
}

TEST(ExploreVerb, JsonLinesAreAllThereIsOnStandardOutput) {
  const ProgramRun result =
      run("explore hull/eight_points_to_four --table --json --quiet --frames 0:8:4");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  std::vector<int> frames;
  for (const std::string& line : lines_of(result.out)) {
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json["schema"], "contactscope.explore/1");
    EXPECT_EQ(json["scenario"], "hull/eight_points_to_four");
    EXPECT_GE(json["points"].size(), 4u);
    EXPECT_GT(json["best_area"].get<double>(), 0);
    EXPECT_EQ(json["reducers"].size(), reducers().size() - 1);
    for (const auto& reducer : json["reducers"]) {
      EXPECT_EQ(reducer.contains("nanoseconds"), json["points"].size() > 4) << reducer["name"];
    }
    if (json["frame"] != 0) {
      EXPECT_EQ(json["points"].size(), 8u);
    }
    frames.push_back(json["frame"].get<int>());
  }
  EXPECT_THAT(frames, ElementsAre(0, 4, 8));
}

TEST(ExploreVerb, ReducerNamesTheOnlyRow) {
  const ProgramRun result =
      run("explore hull/eight_points_to_four --table --frames 0 --reducer area");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(rows_of(result.out), ElementsAre("area"));
}

TEST(ExploreVerb, WithoutContactThereIsANoteAndNoPicture) {
  const TemporaryFolder folder;
  std::string scenario = small_scenario();
  scenario.replace(scenario.find("0.495"), 5, "4.950");
  folder.write("g/apart.toml", scenario);
  const std::string arguments =
      "explore '" + (folder / "g/apart.toml") + "' --out '" + (folder / "out") + "'";
  const ProgramRun result = run(arguments);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr("nothing touches"));
  EXPECT_THAT(files_below(folder / "out"), IsEmpty());
  EXPECT_THAT(run(arguments + " --json").out, IsEmpty());
}

TEST(ExploreVerb, FewPointsAreNotedAsKeptWhole) {
  const TemporaryFolder folder;
  folder.write("g/box.toml", small_scenario());
  const ProgramRun result = run("explore '" + (folder / "g/box.toml") + "' --table");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("2 manifolds of at most 4 points, which every reducer keeps"));
}

TEST(ExploreVerb, UsageErrorsAreTrouble) {
  for (const char* arguments :
       {"explore", "explore hull/nothing_such --table",
        "explore hull/eight_points_to_four --table --reducer magic",
        "explore hull/eight_points_to_four --table --frames 9000",
        "explore hull/eight_points_to_four --table --size 5", "explore hull --table",
        "explore hull/eight_points_to_four hull/face_contact --table"}) {
    const ProgramRun result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.out, IsEmpty()) << arguments;
    EXPECT_THAT(result.err, Not(IsEmpty())) << arguments;
  }
  EXPECT_THAT(run("explore hull/eight_points_to_four --table --reducer magic").err,
              HasSubstr("known are area, "));
}

TEST(ExploreVerb, FullDiskIsTrouble) {
  EXPECT_EQ(run_on_full_disk("explore hull/eight_points_to_four --table --frames 0"), 2);
}

}  // namespace
}  // namespace contactscope::test

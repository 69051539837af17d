#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
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
  EXPECT_THAT(result.err, HasSubstr("no shapes touch"));
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
              HasSubstr("known: 'area', "));
}

TEST(ExploreVerb, FullDiskIsTrouble) {
  EXPECT_EQ(run_on_full_disk("explore hull/eight_points_to_four --table --frames 0"), 2);
}

/// Twelve points on a ring, six of them deep.
std::string twelve(const std::string& name, const std::string& normal = "[0, 1, 0]") {
  std::string text = "[[patch]]\nname = \"" + name + "\"\nnormal = " + normal + "\npoints = [\n";
  for (int i = 0; i < 12; ++i) {
    const double angle = i * std::numbers::pi / 6;
    text += "[" + std::to_string(std::cos(angle)) + ", 0, " + std::to_string(std::sin(angle)) +
            (i % 2 == 0 ? ", -0.003],\n" : ", -0.001],\n");
  }
  return text + "]\n";
}

TEST(ExplorePatch, UserPointsHaveARowForEachReducerAndNoWeight) {
  const TemporaryFolder folder;
  folder.write("mine/twelve.toml", twelve("my twelve"));
  const std::string file = "'" + (folder / "mine/twelve.toml") + "'";
  const ProgramRun table = run("explore --table " + file);
  ASSERT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(rows_of(table.out), testing::SizeIs(reducers().size() - 1));
  EXPECT_THAT(table.err, HasSubstr("1 manifold of at most 12 points"));

  const ProgramRun json = run("explore --table --json --reducer area " + file);
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const auto line = nlohmann::json::parse(json.out);
  EXPECT_EQ(line["label"], "my twelve");
  EXPECT_FALSE(line.contains("a"));
  EXPECT_EQ(line["points"].size(), 12u);
  EXPECT_EQ(line["reducers"][0]["kept"].size(), 4u);
  // Four of a ring of twelve span at best a square of area 2.
  EXPECT_NEAR(line["best_area"].get<double>(), 2, 1e-5);
  EXPECT_FALSE(line["reducers"][0].contains("supports_center_of_mass"));
}

TEST(ExplorePatch, SeveralHaveFoldersOfTheirOwn) {
  const TemporaryFolder folder;
  folder.write("mine/two.toml", twelve("level") + twelve("a/b", "[0, 1, 0.1]"));
  const ProgramRun result = run("explore --quiet --size 640x360 --reducer area --out '" +
                                (folder / "out") + "' '" + (folder / "mine/two.toml") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files_below(folder / "out"), ElementsAre("explore/mine/two/a_b/frame_0000.png",
                                                       "explore/mine/two/level/frame_0000.png"));
}

TEST(ExplorePatch, OtherVerbsTakeItToo) {
  const TemporaryFolder folder;
  folder.write("mine/two.toml", twelve("level") + twelve("tilted", "[0, 1, 0.1]"));
  const std::string file = " '" + (folder / "mine/two.toml") + "'";
  const std::string stored =
      " --out '" + (folder / "out") + "' --snapshots '" + (folder / "snapshots") + "'";
  EXPECT_EQ(
      run("render --quiet --size 640x360" + file + " --out '" + (folder / "out") + "'").exit_code,
      0);
  EXPECT_THAT(files_below(folder / "out"), ElementsAre("mine/two/frame_0000.png"));
  const ProgramRun trace = run("trace" + file);
  EXPECT_EQ(trace.exit_code, 0) << trace.err;
  EXPECT_THAT(lines_of(trace.out), testing::SizeIs(2));
  EXPECT_EQ(run("check --update" + file + stored, "CI=").exit_code, 0);
  const ProgramRun versus = run("versus --table" + file);
  EXPECT_EQ(versus.exit_code, 2);
  EXPECT_THAT(versus.err, HasSubstr("`explore` compares"));
  const ProgramRun check = run("check" + file + stored);
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

}  // namespace
}  // namespace contactscope::test

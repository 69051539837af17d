#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/program.h"
#include "support/json_schema.h"

namespace contactscope::test {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

JsonSchema findings_schema() {
  return JsonSchema(
      Json::parse(read_text(CONTACTSCOPE_SOURCE_DIR "/src/trace/findings.schema.json")));
}

TEST(FindingsSchema, EveryKindOfFindingMatchesIt) {
  const JsonSchema schema = findings_schema();
  const TemporaryFolder folder;
  const auto store = [&](const std::string& name, const std::string& text) {
    folder.write("scenarios/group/" + name + ".toml", text);
  };
  std::vector<Json> seen;
  const auto check = [&](const std::string& arguments) {
    const ProgramRun result =
        run("check --json --scenarios '" + (folder / "scenarios") + "' --snapshots '" +
                (folder / "snapshots") + "' --out '" + (folder / "out") + "' " + arguments,
            "CI=");
    EXPECT_TRUE(result.exit_code != 2 ||
                result.out.find("\"unreadable_scenario\"") != std::string::npos)
        << result.err;
    seen.push_back(Json::parse(result.out));
    EXPECT_THAT(schema.faults(seen.back()), IsEmpty()) << arguments;
  };
  std::string moved = small_scenario();
  moved.replace(moved.find("0.495"), 5, "0.480");
  for (const char* name : {"gone", "torn", "lost", "moved"}) store(name, small_scenario());
  check("--write-missing");
  std::filesystem::remove(folder / "scenarios/group/gone.toml");
  std::filesystem::remove(folder / "snapshots/group/lost/frame_0001.png");
  folder.write("snapshots/group/torn/frame_0001.png", "torn");
  store("young", small_scenario());
  store("broken", "title = 3\n");
  store("moved", moved + "[[expect]]\na = \"slab\"\nb = \"crate\"\npoints = 3\n");
  std::filesystem::copy(folder / "snapshots/group/lost/frame_0000.png",
                        folder / "snapshots/group/moved/frame_0000.bad_1.png");
  check("");
  check("--facts-only --shard 1/2");
  store("moved", small_scenario());
  std::filesystem::remove(folder / "snapshots/group/moved/frame_0000.png");
  check("--update");

  std::set<std::string> kinds;
  for (const Json& document : seen)
    for (const Json& scenario : document["scenarios"])
      for (const Json& finding : scenario["findings"]) kinds.insert(finding["kind"]);
  EXPECT_THAT(kinds, ElementsAre("changed", "known_bad", "missing", "new", "orphaned",
                                 "unmet_expectation", "unreadable", "unreadable_scenario"));
}

TEST(FindingsSchema, DeviationsFromTheSchemaAreFaults) {
  const JsonSchema schema = findings_schema();
  Json document = Json::parse(
      R"({"schema": "contactscope.check/1", "snapshots": "s", "same": false, "summary": "",
          "counts": {"scenarios": 1, "same": 0, "failing": 1, "frames": 1, "pictures": 0, "written": 0,
            "changed": 1, "new": 0, "missing": 0, "orphaned": 0, "unmet_expectation": 0,
            "unreadable": 0, "known_bad": 0},
          "scenarios": [{"scenario": "a/b", "same": false, "frames": 1, "pictures": 0, "written": 0,
            "findings": [{"key": "a/b/trace", "kind": "changed", "sentence": "", "cause": "trace",
              "done": "nothing", "review": "open", "fails": true}]}]})");
  ASSERT_THAT(schema.faults(document), IsEmpty());
  const auto faults_with = [&](const char* place, const Json& value) {
    Json other = document;
    other[Json::json_pointer(place)] = value;
    return schema.faults(other);
  };
  EXPECT_THAT(faults_with("/schema", "contactscope.check/2"), Not(IsEmpty()));
  EXPECT_THAT(faults_with("/counts/new", -1), Not(IsEmpty()));
  EXPECT_THAT(faults_with("/counts/odd", "1"), Not(IsEmpty()));
  EXPECT_THAT(faults_with("/scenarios/0/odd", 1), Not(IsEmpty()));
  EXPECT_THAT(faults_with("/scenarios/0/findings/0/kind", "odd"), Not(IsEmpty()));
  EXPECT_THAT(faults_with("/scenarios/0/findings/0/frame", "0"), Not(IsEmpty()));
  document["scenarios"][0].erase("findings");
  EXPECT_THAT(schema.faults(document), Not(IsEmpty()));
}

}  // namespace
}  // namespace contactscope::test

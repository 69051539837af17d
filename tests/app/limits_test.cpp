#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(StudyLimits, SlowPrintsATableForEachSweepAndMapAndKeepsTheSchema) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("study stability --cases 1 --table --quiet --out '" + (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  for (const char* parameter :
       {"by tilt (rad)", "by size (m)", "by distance from the origin (m)", "by aspect ratio",
        "by angle between edges (rad)", "by overlap, 1 = coincident"}) {
    EXPECT_THAT(result.out, HasSubstr(parameter));
  }
  EXPECT_THAT(result.out, HasSubstr("cells with failures"));
  const auto files = files_below(folder / "out/study/stability");
  EXPECT_EQ(files.size(), 10u);
  for (const std::string& file : files) {
    if (!file.ends_with(".json")) continue;
    const auto json = nlohmann::json::parse(read_text(folder / ("out/study/stability/" + file)));
    EXPECT_EQ(json["schema"], "contactscope.study/1") << file;
    EXPECT_EQ(json["study"], "stability") << file;
    ASSERT_FALSE(json["series"].empty()) << file;
    for (const auto& series : json["series"]) {
      ASSERT_TRUE(series["method"].is_string()) << file;
      for (const auto& point : series["points"]) {
        EXPECT_GE(point["of"].get<int>(), point["failed"].get<int>()) << file;
        EXPECT_EQ(point["error"].is_null(), point["failed"] == point["of"]) << file;
        EXPECT_GT(point["nanoseconds"]["median"].get<double>(), 0) << file;
      }
    }
  }
}

}  // namespace
}  // namespace contactscope::test

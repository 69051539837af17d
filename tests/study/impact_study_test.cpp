#include <gmock/gmock.h>

#include <string>

#include "study/impact_cases.h"
#include "study/study.h"
#include "study_lines.h"

namespace contactscope {
namespace {

using test::line_of;

TEST(TimeOfImpactStudy, SlowOursMissNothingAndSamplingDoes) {
  StudyOptions options;
  options.cases = 6;
  options.repetitions = 1;
  const auto results = study_time_of_impact(options, [](int, int, const std::string&) {});
  ASSERT_EQ(results.size(), 2);
  int checked = 0;
  for (const trace::StudySeries& series : results[0].series) {
    if (series.method.ends_with("samples")) continue;
    for (const trace::StudyPoint& point : series.points) {
      EXPECT_EQ(point.failed, 0) << series.method << ' ' << series.panel << ' ' << point.parameter;
      EXPECT_EQ(point.of, 6);
      EXPECT_LT(point.error.value_or(0), 2e-4) << series.method << ' ' << series.panel;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 4 * (4 + 4 + 6));
  // In a step of a hundred metres, the hulls overlap for two metres.
  EXPECT_GT(line_of(results[0], "translating", "8 samples").points.back().failed, 1);
  EXPECT_GT(*line_of(results[1], "translating", "8 samples").points.back().error, 0.1);
}

TEST(TimeOfImpactStudy, SlowErrorsAreThoseOfAnyNumberOfThreads) {
  const auto errors = [](int threads) {
    StudyOptions options;
    options.cases = 5;
    options.repetitions = 1;
    options.threads = threads;
    std::vector<std::optional<double>> list;
    for (const trace::Study& study :
         study_time_of_impact(options, [](int, int, const std::string&) {}))
      for (const trace::StudySeries& series : study.series)
        for (const trace::StudyPoint& point : series.points) list.push_back(point.error);
    return list;
  };
  const std::vector<std::optional<double>> alone = errors(1);
  EXPECT_GT(alone.size(), 100U);
  EXPECT_EQ(errors(3), alone);
}

TEST(TunnellingStudy, SlowNothingPassesATimeOfImpact) {
  StudyOptions options;
  options.cases = 20;
  options.repetitions = 1;
  const auto results = study_tunnelling(options, [](int, int, const std::string&) {});
  ASSERT_EQ(results.size(), 2);
  ASSERT_EQ(results[0].series.size(), 6 * 5);
  for (const trace::StudySeries& series : results[0].series) {
    const bool continuous = series.method == "time of impact" ||
                            series.method == "conservative advancement" ||
                            series.method == "swept bounding sphere";
    for (const trace::StudyPoint& point : series.points) {
      ASSERT_TRUE(point.error);
      EXPECT_TRUE(!continuous || *point.error == 0) << series.method << ' ' << series.panel;
    }
  }
  // At 5 m/s a sphere moves 8 cm a step, less than its size plus the wall's; at 1000 m/s 17 m.
  const auto& discrete = line_of(results[0], "spheres, a wall of 1 cm", "discrete");
  EXPECT_LT(*discrete.points.front().error, 0.7);
  EXPECT_GT(*discrete.points.back().error, 0.9);
  const auto& swept = line_of(results[1], "spinning rods, a wall of 1 cm", "swept bounding sphere");
  const auto& exact = line_of(results[1], "spinning rods, a wall of 1 cm", "time of impact");
  EXPECT_GT(*swept.points.back().error, 0.05);
  EXPECT_LT(*exact.points.back().error, 1e-3);
}

}  // namespace
}  // namespace contactscope

#include <gmock/gmock.h>

#include "study/study.h"

namespace contactscope {
namespace {

std::vector<trace::Study> small_study(int cases) {
  StudyOptions options;
  options.cases = cases;
  options.repetitions = 1;
  return study_overlap(options, [](int, int, const auto&) {});
}

TEST(OverlapStudy, LooserBoundsLetMoreThroughAndNoneLosesAnOverlap) {
  const std::vector<trace::Study> studies = small_study(3000);
  ASSERT_EQ(studies.size(), 3u);
  const trace::Study& bounds = studies[0];
  EXPECT_EQ(bounds.measure, "false_positives");
  ASSERT_EQ(bounds.series.size(), 4u);
  for (const trace::StudySeries& series : bounds.series) {
    ASSERT_EQ(series.points.size(), 3u);
    for (const trace::StudyPoint& point : series.points) {
      EXPECT_EQ(point.failed, 0) << series.method << " " << point.parameter;
      EXPECT_GT(point.nanoseconds.min, 0);
    }
  }
  // By the mean volumes of the Minkowski sums, a sphere wrongly passes 49.5 % of cubes: the sum of
  // two cubes has a mean of 11 m^3, that of their spheres 21.8.
  EXPECT_NEAR(*bounds.series[1].points[0].error, 0.495, 0.04);
  EXPECT_NEAR(*bounds.series[0].points[0].error, 0.6, 0.04);
  for (std::size_t p = 0; p < 3; ++p) {
    const double aabb = *bounds.series[0].points[p].error;
    const double six = *bounds.series[2].points[p].error;
    EXPECT_GT(aabb, six);
    EXPECT_GT(six, 0.02);
    EXPECT_EQ(*bounds.series[3].points[p].error, 0);
  }
}

TEST(OverlapStudy, ALowThresholdMissesAHighOneSeesPhantomsAndTheGuardDoesNeither) {
  const std::vector<trace::Study> studies = small_study(3000);
  for (std::size_t s = 1; s < 3; ++s) {
    const trace::Study& study = studies[s];
    ASSERT_EQ(study.series.size(), 8u);
    for (const trace::StudySeries& series : study.series) {
      ASSERT_EQ(series.points.size(), 14u);
      const bool guarded = series.method.find("guarded") != std::string::npos;
      const auto error = [&](std::size_t k) {
        const trace::StudyPoint& point = series.points[k];
        return *point.error_worst;
      };
      const double none = study.resolution;
      for (std::size_t k = 0; k < 14; ++k) {
        EXPECT_GE(error(k), none);
        if (guarded) {
          EXPECT_EQ(error(k), none) << series.method;
        }
      }
      if (guarded) continue;
      const bool missed = series.panel == "overlaps called apart";
      // None skipped, and up to a tenth skipped.
      EXPECT_EQ(error(0) > none, missed) << series.method << ", " << series.panel;
      EXPECT_EQ(error(13) > none, !missed) << series.method << ", " << series.panel;
    }
  }
}

}  // namespace
}  // namespace contactscope

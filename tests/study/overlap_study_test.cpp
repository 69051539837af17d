#include <gmock/gmock.h>

#include <numbers>

#include "study/exhaustive_boxes.h"
#include "study/study.h"

namespace contactscope {
namespace {

const std::vector<trace::Study>& small_overlap_study() {
  static const std::vector<trace::Study> studies = [] {
    StudyOptions options;
    options.cases = 3000;
    options.repetitions = 1;
    return study_overlap(options, [](int, int, const auto&) {});
  }();
  return studies;
}

TEST(OverlapStudy, LooserBoundsLetMoreThroughAndNoneLosesAnOverlap) {
  const std::vector<trace::Study>& studies = small_overlap_study();
  ASSERT_EQ(studies.size(), 4u);
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

// A corner in the middle of a face, and two ridges that have passed each other.
TEST(OverlapStudy, TheLecturesSearchFindsWhatItsSlidesDraw) {
  const Vec3d cube = Vec3d::Ones();
  const Quatd on_corner = Quatd::FromTwoVectors(Vec3d::Ones(), Vec3d::UnitY());
  const auto corner = exhaustive_contact(cube, cube, {on_corner, {0.1, 0.9 + std::sqrt(3), 0.2}});
  ASSERT_TRUE(corner.has_value());
  EXPECT_NEAR(corner->depth, 0.1, 1e-12);
  EXPECT_LT((corner->normal - Vec3d::UnitY()).norm(), 1e-12);
  const Pose<double> across{Quatd(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3d::UnitX())),
                            Vec3d::Zero()};
  const Pose<double> ridge{Quatd(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3d::UnitZ())),
                           Vec3d::Zero()};
  const Vec3d bar(3, 1, 1), other(1, 1, 3);
  // Two ridges that cross at right angles, 0.2 past each other along y.
  const Pose<double> b_in_a = [&] {
    const Pose<double> b{ridge.rotation, {0.3, 2 * std::sqrt(2.0) - 0.2, 0.4}};
    return relative_pose(across, b);
  }();
  const auto edges = exhaustive_contact(bar, other, b_in_a);
  ASSERT_TRUE(edges.has_value());
  EXPECT_NEAR(edges->depth, 0.2, 1e-12);
  EXPECT_LT((across.rotate(edges->normal) - Vec3d::UnitY()).norm(), 1e-12);
}

TEST(OverlapStudy, TheLecturesSearchGetsDeepBoxesWrong) {
  const trace::Study& study = small_overlap_study().back();
  EXPECT_EQ(study.measure, "boxes");
  const auto& [lecture, sat] = std::pair(study.series.at(0), study.series.at(1));
  for (const trace::StudyPoint& point : sat.points) {
    EXPECT_EQ(*point.error, 0);
    EXPECT_EQ(point.failed, 0);
  }
  EXPECT_GT(*lecture.points.back().error, 0.2);
}

TEST(OverlapStudy, ALowThresholdMissesAHighOneSeesPhantomsAndTheGuardDoesNeither) {
  const std::vector<trace::Study>& studies = small_overlap_study();
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

#include <gtest/gtest.h>

#include "geometry/primitives.h"
#include "study/study.h"
#include "support/brute_force_sat.h"

namespace contactscope {
namespace {

/// How near a unit vector is to an axis of a cube: 1 for the same direction.
double along_axis(const Vec3d& normal, const Mat3<double>& axes) {
  return (axes.transpose() * normal).cwiseAbs().maxCoeff();
}

// Without a preference the features are those of the least overlap by brute force; the poses are
// built again, from a matrix.
TEST(PhaseStudy, EachCellNamesTheFeaturesOfLeastOverlap) {
  const std::vector<trace::Study> studies = study_phase({}, [](int, int, const std::string&) {});
  ASSERT_EQ(studies.size(), 1u);
  const Hull<double> cube = make_box(Vec3d(0.5, 0.5, 0.5));
  int cells = 0, edges[2] = {0, 0};
  for (const trace::StudySeries& row : studies[0].series) {
    const bool prefers = row.panel == "preference relative";
    // B's axes: x turned by 12 degrees about the vertical, the other two tilted about it.
    const double turn = 12 * std::numbers::pi / 180, tilt = *row.row * std::numbers::pi / 180;
    const Vec3d across(std::cos(turn), 0, -std::sin(turn)),
        level(std::sin(turn), 0, std::cos(turn));
    Mat3<double> axes;
    axes << across, std::cos(tilt) * Vec3d::UnitY() + std::sin(tilt) * level,
        std::cos(tilt) * level - std::sin(tilt) * Vec3d::UnitY();
    for (const trace::StudyPoint& point : row.points) {
      ASSERT_TRUE(point.error.has_value());
      edges[prefers] += *point.error == 3;
      if (prefers || ++cells % 7 != 0) continue;
      // The middle of B's lower edge is 30 mm deep.
      const Vec3d lower(0, 0.47, 1e-3 * point.parameter);
      const Pose<double> pose{Quatd(axes), lower + 0.5 * axes.col(1) - 0.5 * axes.col(2)};
      const test::BruteForceAxis least = test::brute_force_sat(cube, {}, cube, pose);
      const double of_a = along_axis(least.normal, Mat3<double>::Identity()),
                   of_b = along_axis(least.normal, axes);
      const double found = *point.error;
      if (found == 0) {
        EXPECT_GT(least.separation, -1e-12);
      }
      if (found == 1) {
        EXPECT_NEAR(of_a, 1, 1e-9);
      }
      if (found == 2) {
        EXPECT_NEAR(of_b, 1, 1e-9);
      }
      if (found == 3) {
        EXPECT_LT(std::max(of_a, of_b), 1 - 1e-9);
      }
      if (HasFailure()) FAIL() << row.panel << ", " << point.parameter << " mm, " << *row.row;
    }
  }
  EXPECT_GT(edges[0], 0);
  EXPECT_LT(edges[1], edges[0]) << "faces win where they are nearly as deep";
}

}  // namespace
}  // namespace contactscope

#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/primitives.h"
#include "query/minkowski_difference.h"
#include "query/simplex.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// Steps of GJK as in gjk.cpp, up to its cap; or without its tolerances for steps and for faces of a
/// simplex.
int steps_of(const MinkowskiDifference<float>& difference, bool has_tolerances) {
  const float scale = has_tolerances ? difference.scale() : 0;
  std::array<Vec3f, 4> points = {
      difference.point(difference.support_against(difference.between_middles()))};
  NearestOnSimplex<float> nearest;
  nearest_on_simplex(points, 1, scale, nearest);
  for (int step = 1; step < kMaxGjkIterations; ++step) {
    const Vec3f direction = nearest.direction.normalized();
    const Vec3f point = difference.point(difference.support_against(direction));
    float gain = std::numeric_limits<float>::infinity();
    const auto count = static_cast<std::size_t>(nearest.count);
    for (std::size_t i = 0; i < count; ++i) gain = std::min(gain, direction.dot(points[i] - point));
    if (!(gain > tie_tolerance(scale))) return step;
    points[count] = point;
    nearest_on_simplex(points, nearest.count + 1, scale, nearest);
    if (nearest.count == 4) return step;
    for (std::size_t i = 0; i < static_cast<std::size_t>(nearest.count); ++i)
      points[i] = points[static_cast<std::size_t>(nearest.kept[i])];
  }
  return kMaxGjkIterations;
}

/// The drums of scenario query/gjk_limits, in other places: many support points are nearly coplanar.
TEST(GjkWithoutTolerances, OneInFiftyNeverEndsAndWithThemAllEndWithinTwentySteps) {
  const Hull<float> drum = hull_cast<float>(make_cylinder(0.5, 0.2, 16));
  const SupportSet<float> set = support_set(drum);
  std::mt19937_64 engine(1);
  int never = 0, most = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3d axis(uniform(engine, -1, 1), 0, uniform(engine, -1, 1));
    const Quatd turn = Eigen::AngleAxisd(1.7e-4, axis.normalized()) *
                       Eigen::AngleAxisd(uniform(engine, -3, 3), Vec3d::UnitY());
    const Vec3d place(uniform(engine, -0.3, 0.3), 0.5, uniform(engine, -0.3, 0.3));
    const MinkowskiDifference<float> difference(set, set, Pose<double>{turn, place}.cast<float>());
    never += steps_of(difference, false) == kMaxGjkIterations;
    most = std::max(most, steps_of(difference, true));
  }
  EXPECT_GE(never, 20);
  EXPECT_LE(most, 20);
  RecordProperty("never", never);
}

}  // namespace
}  // namespace contactscope

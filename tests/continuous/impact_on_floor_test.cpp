#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "continuous/impact_of_shapes.h"
#include "geometry/primitives.h"
#include "support/brute_force_distance.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/random_geometry.h"

/// Shapes fall on floors up to ten thousand times as large. They meet at the vertical separation
/// over the speed, both in extended precision. The result is never late, and early only by the
/// rounding of the features that touch, wherever the floor's corners are.
namespace contactscope {
namespace {

using test::Extended;
using test::ExtendedPoint;
using test::Random;

enum class Floor { Box, Plane, Mesh };

struct Fall {
  Floor kind = Floor::Box;
  double size = 1, reach = 1;
  Shape<double> floor, falling;
  Sweep<double> of_floor, of_falling;
  double truth = 0;  // fraction of the step
  double speed = 0;  // vertical, metres per step
};

template <class S> Pose<double> rounded(const Pose<double>& pose) {
  return pose.cast<S>().template cast<double>();
}
template <class S> Vec3d rounded(const Vec3d& vector) {
  return vector.cast<S>().template cast<double>();
}

Shape<double> floor_of(Floor kind, double reach, double top) {
  switch (kind) {
    case Floor::Box:
      return make_box(Vec3d(reach, top, reach));
    case Floor::Plane:
      return HalfSpace<double>{{Vec3d::UnitY(), top}};
    case Floor::Mesh:
      break;
  }
  return build_mesh(
      {{-reach, top, -reach}, {reach, top, -reach}, {reach, top, reach}, {-reach, top, reach}},
      {{{0, 2, 1}}, {{0, 3, 2}}});
}

Shape<double> falling_of(Random& random, double size) {
  switch (random.index(4)) {
    case 0:
      return Sphere<double>{size};
    case 1:
      return Capsule<double>{{Vec3d(0, -size, 0), Vec3d(0, size, 0)}, 0.5 * size};
    case 2:
      return make_box(size * Vec3d(1, 0.5, 0.75));
    default:
      return test::random_hull(random, 6 + random.index(8), size, 2);
  }
}

std::vector<ExtendedPoint> core_points(const Shape<double>& shape, const Pose<double>& pose) {
  if (std::holds_alternative<Sphere<double>>(shape))
    return test::features_of_point(Vec3d::Zero(), pose).vertices;
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape))
    return test::features_of_segment(capsule->points[0], capsule->points[1], pose).vertices;
  return test::features_of(std::get<Hull<double>>(shape), pose).vertices;
}

double radius_of(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape)) return sphere->radius;
  const auto* capsule = std::get_if<Capsule<double>>(&shape);
  return capsule ? capsule->radius : 0;
}

/// In numbers that S represents.
template <class S> Fall random_fall(Random& random) {
  Fall fall;
  fall.kind = static_cast<Floor>(random.index(3));
  fall.size = random.decade(-4, 4);
  fall.reach = fall.size * random.decade(0.7, 4);
  const double top = static_cast<double>(static_cast<S>(fall.size * random.uniform(0.2, 2)));
  fall.floor = floor_of(fall.kind, static_cast<double>(static_cast<S>(fall.reach)), top);
  if (random.chance(0.5))
    fall.of_floor.start = {test::about(Vec3d::UnitY(), random.uniform(-3, 3)),
                           random.vector(-1, 1) * fall.reach};
  if (random.chance(0.3)) fall.of_floor.start.rotation = random.rotation();
  fall.of_floor.start = rounded<S>(fall.of_floor.start);
  fall.falling = falling_of(random, fall.size);
  if (const auto* hull = std::get_if<Hull<double>>(&fall.falling))
    fall.falling = hull_cast<double>(hull_cast<S>(*hull));
  else if (auto* sphere = std::get_if<Sphere<double>>(&fall.falling))
    sphere->radius = static_cast<double>(static_cast<S>(sphere->radius));
  else
    fall.falling = shape_cast<double>(fall.falling);
  if (auto* capsule = std::get_if<Capsule<double>>(&fall.falling)) {
    for (Vec3d& end : capsule->points) end = rounded<S>(end);
    capsule->radius = static_cast<double>(static_cast<S>(capsule->radius));
  }
  Pose<double> own{random.rotation(), random.level(fall.reach - 4 * fall.size, 0)};
  const double gap = fall.size * random.decade(-1, 1);
  own.position.y() = top + gap + 2 * fall.size;
  Pose<double> pose = compose(fall.of_floor.start, own);
  pose.rotation.normalize();
  fall.of_falling.start = rounded<S>(pose);
  const Vec3d offset(random.uniform(-1, 1) * fall.size,
                     -random.uniform(1.5, 4) * (gap + 4 * fall.size),
                     random.uniform(-1, 1) * fall.size);
  fall.of_falling.displacement = rounded<S>(fall.of_floor.start.rotate(offset));

  const Eigen::Quaternion<Extended> rotation =
      fall.of_floor.start.rotation.cast<Extended>().normalized();
  const ExtendedPoint up = rotation * ExtendedPoint(0, 1, 0);
  Extended lowest = std::numeric_limits<Extended>::infinity();
  for (const ExtendedPoint& point : core_points(fall.falling, fall.of_falling.start))
    lowest = std::min(lowest, up.dot(point - fall.of_floor.start.position.cast<Extended>().eval()));
  const Extended speed = -up.dot(fall.of_falling.displacement.cast<Extended>().eval());
  fall.speed = static_cast<double>(speed);
  fall.truth = static_cast<double>(
      (lowest - static_cast<Extended>(top) - static_cast<Extended>(radius_of(fall.falling))) /
      speed);
  return fall;
}

template <class S>
ShapeImpact<S> impact_of(const Fall& fall, const ImpactLimits<S>& limits, bool swapped) {
  const Shape<S> floor = shape_cast<S>(fall.floor), falling = shape_cast<S>(fall.falling);
  const Sweep<S> of_floor = fall.of_floor.cast<S>(), of_falling = fall.of_falling.cast<S>();
  return swapped ? impact_of_shapes(falling, of_falling, floor, of_floor,
                                    ImpactMethod::TimeOfImpact, limits)
                 : impact_of_shapes(floor, of_floor, falling, of_falling,
                                    ImpactMethod::TimeOfImpact, limits);
}

template <class S> void judge_falls(int count, std::uint64_t seed) {
  constexpr double kOfMotion = 1e-8;
  Random random(seed);
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const Fall fall = random_fall<S>(random);
    SCOPED_TRACE(testing::Message()
                 << "fall " << i << " on " << static_cast<int>(fall.kind) << " of " << fall.reach
                 << ", size " << fall.size << ", " << to_string(kind_of(fall.falling)));
    const ImpactResult<S> found =
        impact_of<S>(fall, {.of_motion = static_cast<S>(kOfMotion)}, i % 2 == 1).result;
    ASSERT_EQ(found.status, ImpactStatus::Hit);
    // Roundings of the time, of the motion in the step, and of the touching features in double.
    const double epsilon = std::numeric_limits<S>::epsilon();
    const double extents = 64 * std::numeric_limits<double>::epsilon() * fall.reach;
    const double late = (fall.truth - static_cast<double>(found.time)) * fall.speed;
    EXPECT_GE(late, -extents) << "late";
    EXPECT_LE(late,
              epsilon * fall.speed + kOfMotion * fall.of_falling.displacement.norm() + extents);
  }
}

/// A ball falls 10 m in the step, over floors of 5 m to 5 km.
TEST(ImpactOnFloor, AFloorsReachMakesNoImpactEarly) {
  for (const double reach : {5.0, 50.0, 500.0, 5000.0}) {
    Fall fall;
    fall.floor = make_box(Vec3d(reach, 1, reach));
    fall.of_floor.start = test::at(0, -1, 0);
    fall.falling = Sphere<double>{static_cast<double>(0.5166F)};
    fall.of_falling.start = test::at(-0.9 * reach, 4.25, 0.8 * reach);
    fall.of_falling.displacement = Vec3d(0, -10, 0);
    const double truth = (4.25 - static_cast<double>(0.5166F)) / 10;
    const ImpactResult<float> found = impact_of<float>(fall, {.of_motion = 1e-8F}, false).result;
    EXPECT_LE(static_cast<double>(found.time), truth);
    EXPECT_GE(static_cast<double>(found.time), truth - 1e-7) << "a micrometre, " << reach;
  }
}

TEST(ImpactOnFloor, RandomFallsInDouble) { judge_falls<double>(2000, 349); }
TEST(ImpactOnFloor, RandomFallsInFloat) { judge_falls<float>(2000, 350); }
TEST(ImpactOnFloor, SlowRandomFalls) {
  judge_falls<double>(test::cases(20000), 351);
  judge_falls<float>(test::cases(20000), 352);
}

}  // namespace
}  // namespace contactscope

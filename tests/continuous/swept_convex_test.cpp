#include "continuous/swept_convex.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <optional>

#include "geometry/primitives.h"
#include "support/brute_force_distance.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Extended;
using test::ExtendedPoint;
using test::Features;
using test::Random;

/// The first time at which a shape is within `radius` of a triangle, by steps as long as the
/// distance allows. `at_time` returns the shape at a time.
std::optional<Extended> marched(const std::function<Features(Extended)>& at_time,
                                const Features& triangle, Extended speed, Extended radius) {
  Extended time = 0;
  for (int i = 0; i < 4000; ++i) {
    const Extended gap = brute_force_distance(at_time(time), triangle).distance - radius;
    if (gap <= 1e-12L * (radius + speed)) return time;
    time += gap / speed;
    if (time > 1) return std::nullopt;
  }
  return time;
}

/// A triangle, sometimes a needle or flat, and a body of similar size that flies at it or past it.
struct SweptCase {
  double size;
  std::array<Vec3d, 3> triangle;
  Pose<double> start;
  Vec3d offset;
  double radius;

  SweptCase(Random& random, double away) : size(away > 0 ? 1.0 : random.decade(-4, 4)) {
    const Vec3d place = away * random.unit_vector();
    for (Vec3d& corner : triangle) corner = place + size * random.vector(-1, 1);
    if (random.chance(0.2)) triangle[2] = 0.3 * triangle[0] + 0.7 * triangle[1];
    if (random.chance(0.1)) triangle[2] += 1e-7 * size * random.unit_vector();
    start = random.pose(0);
    start.position = place + 4 * size * random.unit_vector();
    const Vec3d aim = place + 1.5 * size * random.vector(-1, 1);
    offset = random.decade(-0.2, 1) * (aim - start.position);
    radius = random.chance(0.2) ? 1e-3 * size : random.uniform(0.05, 0.5) * size;
  }
  Features features() const {
    std::array<ExtendedPoint, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = (triangle[i] - triangle[0]).cast<Extended>();
    return test::features_of_triangle(corners);
  }
  /// The shape's pose at a time, relative to the triangle's first corner.
  Pose<double> pose(Extended time) const {
    return {start.rotation, start.position - triangle[0] + static_cast<double>(time) * offset};
  }
};

struct SweptTally {
  int hits = 0, separated = 0;

  void compare(const SweptHit& found, const std::optional<Extended>& surely,
               const std::optional<Extended>& perhaps, int index) {
    if (surely) {
      EXPECT_EQ(found.status, SweptStatus::Hit) << "missed " << index;
      EXPECT_LE(found.time, static_cast<double>(*surely) + 1e-7) << "late " << index;
    }
    EXPECT_TRUE(perhaps || found.status == SweptStatus::Separated) << "invented " << index;
    if (found.status == SweptStatus::Hit) {
      ++hits;
      EXPECT_GE(found.time, static_cast<double>(perhaps.value_or(0)) - 1e-7) << index;
      EXPECT_NEAR(found.normal.norm(), 1, 1e-9);
    } else {
      ++separated;
    }
  }
};

void capsules_are_as_marching_says(double away) {
  Random random(51);
  SweptTally tally;
  for (int i = 0; i < 8000; ++i) {
    const SweptCase of(random, away);
    const double length = random.chance(0.1) ? 0 : of.size;
    const Vec3d half(length * random.uniform(0.1, 1), 0, 0);
    const auto capsule = [&](Extended time) {
      return test::features_of_segment(-half, half, of.pose(time));
    };
    const std::array<Vec3d, 2> ends = {of.start.transform(-half), of.start.transform(half)};
    const SweptHit found = sweep_capsule_triangle<double>(ends, of.offset, of.radius, of.triangle);
    const Extended speed = of.offset.norm(), radius = of.radius;
    tally.compare(found, marched(capsule, of.features(), speed, radius * (1 - 1e-6L)),
                  marched(capsule, of.features(), speed, radius * (1 + 1e-6L)), i);
  }
  EXPECT_GT(tally.hits, 1500);
  EXPECT_GT(tally.separated, 2000);
}

TEST(SweptCapsule, SlowMatchesMarching) {
  capsules_are_as_marching_says(0);
  capsules_are_as_marching_says(1000);
}

TEST(SweptBox, SlowMatchesMarching) {
  for (const double away : {0.0, 1000.0}) {
    Random random(52);
    SweptTally tally;
    for (int i = 0; i < 1500; ++i) {
      const SweptCase of(random, away);
      const Vec3d half = of.size * (random.vector(0.05, 0.6));
      const double grown = 1e-6 * of.size;
      const auto box = [&](double by) {
        const Hull<double> hull = make_box(half + Vec3d::Constant(by));
        return [&of, hull](Extended time) { return test::features_of(hull, of.pose(time)); };
      };
      const Obb<double> placed{of.start.position, of.start.rotation.toRotationMatrix(), half};
      const SweptHit found = sweep_box_triangle<double>(placed, of.offset, of.triangle);
      const Extended speed = of.offset.norm();
      tally.compare(found, marched(box(-grown), of.features(), speed, 0),
                    marched(box(grown), of.features(), speed, 0), i);
    }
    EXPECT_GT(tally.hits, 300);
    EXPECT_GT(tally.separated, 400);
  }
}

TEST(SweptCapsule, OverlapsAtTheStartForAnyDisplacement) {
  const std::array<Vec3d, 3> triangle = {Vec3d(0, 0, 0), Vec3d(4, 0, 0), Vec3d(0, 4, 0)};
  const std::array<Vec3d, 3> turned = {triangle[0], triangle[2], triangle[1]};
  for (const Vec3d& offset : {Vec3d(0, 0, 2), Vec3d(0, 0, -2), Vec3d(3, 0, 0), Vec3d(0, 0, 0)}) {
    for (const double side : {-1.0, 1.0}) {
      const auto overlaps = [&](double radius, const std::array<Vec3d, 3>& corners) {
        const std::array<Vec3d, 2> ends = {Vec3d(1, 1, side * 0.3), Vec3d(1.1, 1, side * 0.6)};
        const std::array<Vec3d, 2> other_direction = {ends[1], ends[0]};
        const SweptStatus status =
            sweep_capsule_triangle<double>(ends, offset, radius, corners).status;
        EXPECT_EQ(sweep_capsule_triangle<double>(other_direction, offset, radius, corners).status,
                  status);
        return status == SweptStatus::Overlapping;
      };
      EXPECT_TRUE(overlaps(0.301, triangle) && overlaps(0.301, turned)) << offset.transpose();
      EXPECT_FALSE(overlaps(0.299, triangle) || overlaps(0.299, turned)) << offset.transpose();
    }
  }
}

TEST(SweptConvex, DistinguishesInitialOverlapFromAHit) {
  const std::array<Vec3d, 3> triangle = {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0)};
  const Vec3d down(0, 0, -2);
  const std::array<Vec3d, 2> above = {Vec3d(0.2, 0.2, 1), Vec3d(0.3, 0.2, 1)};
  const SweptHit hit = sweep_capsule_triangle<double>(above, down, 0.5, triangle);
  EXPECT_EQ(hit.status, SweptStatus::Hit);
  EXPECT_NEAR(hit.time, 0.25, 1e-15);
  EXPECT_NEAR(hit.normal.z(), 1, 1e-15);
  const std::array<Vec3d, 2> through = {Vec3d(0.2, 0.2, 5), Vec3d(0.2, 0.2, -5)};
  EXPECT_EQ(sweep_capsule_triangle<double>(through, down, 0.5, triangle).status,
            SweptStatus::Overlapping);
  Obb<double> box{Vec3d(0.2, 0.2, 1), Mat3<double>::Identity(), Vec3d(0.1, 0.1, 0.5)};
  const SweptHit fallen = sweep_box_triangle<double>(box, down, triangle);
  EXPECT_EQ(fallen.status, SweptStatus::Hit);
  EXPECT_EQ(fallen.time, 0.25);
  EXPECT_EQ(fallen.normal, Vec3d(0, 0, 1));
  box.center.z() = 0.3;
  EXPECT_EQ(sweep_box_triangle<double>(box, down, triangle).status, SweptStatus::Overlapping);
  // It moves away, and sideways.
  box.center.z() = 1;
  EXPECT_EQ(sweep_box_triangle<double>(box, Vec3d(-down), triangle).status, SweptStatus::Separated);
  EXPECT_EQ(sweep_box_triangle<double>(box, Vec3d(10, 0, 0), triangle).status,
            SweptStatus::Separated);
}

}  // namespace
}  // namespace contactscope

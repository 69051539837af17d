#include <gtest/gtest.h>

#include "support/brute_force_sat.h"
#include "support/builders.h"

// Overlap always gives a contact of the right depth, at any place.
namespace contactscope {
namespace {

using test::collide;
using test::deepest;
using test::PairCase;

double oracle(const PairCase<double>& pair) {
  return test::brute_force_sat(pair.a, pair.pose_a, pair.b, pair.pose_b).separation;
}

template <class S> class Overlap : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Overlap, Scalars);

TYPED_TEST(Overlap, AHullWithItselfInPlaceHasPoints) {
  using S = TypeParam;
  test::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Hull<double> hull = test::random_hull(random, 4 + random.index(40), 1, 10);
    const Pose<double> pose = random.pose(5);
    const PairCase<S> pair = PairCase<double>{hull, pose, hull, pose}.cast<S>();
    for (const Preference preference : {Preference::Relative, Preference::None}) {
      CollideOptions options;
      options.preference = preference;
      const Manifold<S> manifold = collide(pair, options);
      ASSERT_FALSE(manifold.points.empty()) << i;
      ASSERT_LT(deepest(manifold), 0);
    }
  }
}

TYPED_TEST(Overlap, APointedHullDeepInsideHasPoints) {
  using S = TypeParam;
  test::Random random(2);
  for (int i = 0; i < 500; ++i) {
    PairCase<double> pair{test::random_hull(random, 6 + random.index(30), 1, 2),
                          {},
                          test::random_hull(random, 4, 0.3, 30),
                          {}};
    pair.pose_b = {random.rotation(), 0.5 * random.uniform(0, 1) * random.unit_vector()};
    const PairCase<S> placed = test::moved(pair, random.pose(5)).cast<S>();
    const double expected = oracle(placed.template cast<double>());
    if (expected > -1e-4) continue;
    const Manifold<S> manifold = collide(placed);
    ASSERT_FALSE(manifold.points.empty()) << i;
    const double smaller = static_cast<double>(std::min(placed.a.radius, placed.b.radius));
    ASSERT_NEAR(deepest(manifold), expected, std::max(-0.05 * expected, 0.002 * smaller) + 1e-5);
  }
}

TYPED_TEST(Overlap, ACoveringBodyIsNeverLostBetweenFaces) {
  using S = TypeParam;
  // The support vertex of a truncated pyramid's least deep face may be outside the face, because
  // the sides slope outwards below it. Then the clip alone is not deep enough.
  test::Random random(3);
  int checked = 0;
  for (int i = 0; i < 1000; ++i) {
    PairCase<double> pair{
        make_cone(1, 0.3, 3 + random.index(9)), {}, make_cone(0.4, 0.6, 3 + random.index(9)), {}};
    pair.pose_b = {random.rotation(), random.uniform(0.2, 0.9) * random.unit_vector()};
    const PairCase<S> placed = test::moved(pair, random.pose(5)).cast<S>();
    const double expected = oracle(placed.template cast<double>());
    if (expected > -1e-4) continue;
    ++checked;
    const Manifold<S> manifold = collide(placed);
    ASSERT_FALSE(manifold.points.empty()) << i;
    const double smaller = static_cast<double>(std::min(placed.a.radius, placed.b.radius));
    ASSERT_NEAR(deepest(manifold), expected, std::max(-0.05 * expected, 0.002 * smaller) + 1e-5);
  }
  EXPECT_GT(checked, 300);
}

TYPED_TEST(Overlap, IsTheSameAtEveryPoseOfThePair) {
  using S = TypeParam;
  const double rounding = 64 * std::numeric_limits<S>::epsilon();
  test::Random random(4);
  for (const PairCase<double>& pair :
       {test::stacked_cubes(0.4, 0.01), test::crossed_edges(1, 0.01),
        PairCase<double>{make_box({1, 0.5, 1}), test::at(0, -0.5, 0), make_cylinder(0.3, 0.4, 16),
                         test::at(0.1, 0.395, -0.2)}}) {
    const Manifold<double> home = collide(pair);
    ASSERT_FALSE(home.points.empty());
    for (int i = 0; i < 200; ++i) {
      const Pose<double> by = random.pose(5);
      const Manifold<S> manifold = collide(test::moved(pair, by).cast<S>());
      ASSERT_EQ(test::sorted_ids(manifold), test::sorted_ids(home));
      const Vec3d normal = by.inverse_rotate(manifold.normal.template cast<double>());
      ASSERT_LT((normal - home.normal).norm(), rounding);
      for (const ContactPoint<S>& point : manifold.points) {
        const auto same = std::find_if(home.points.begin(), home.points.end(),
                                       [&](const auto& other) { return other.id == point.id; });
        const Vec3d place = by.inverse_transform(point.position.template cast<double>());
        ASSERT_LT((place - same->position).norm(), 8 * rounding);
        ASSERT_NEAR(point.separation, same->separation, rounding);
      }
    }
  }
}

TYPED_TEST(Overlap, FarFromTheOriginLosesOnlyWhatThePosesLost) {
  using S = TypeParam;
  // Poses at whole metres are exact in a float here; coordinates of results are not.
  PairCase<double> pair{test::cube(0.5), test::at(100000, 0, -50000), test::cube(0.5),
                        test::at(100000, 0.9375, -50000)};
  const Manifold<S> manifold = collide(pair.cast<S>());
  ASSERT_EQ(manifold.points.size(), 4u);
  for (const ContactPoint<S>& point : manifold.points) {
    EXPECT_EQ(point.separation, S(-0.0625));
    EXPECT_EQ(point.position.y(), S(0.5));
  }
}

TYPED_TEST(Overlap, BeginsWhereTheGapEnds) {
  using S = TypeParam;
  // From 1 cm of separation to 1 cm of overlap in steps of 0.1 mm: depth grows, normals stay.
  double before = std::numeric_limits<double>::infinity();
  for (int step = -100; step <= 100; ++step) {
    const double overlap = step * 1e-4;
    const Manifold<S> manifold = collide(test::stacked_cubes(0.3, overlap).cast<S>());
    if (overlap < -1e-6) {
      ASSERT_TRUE(manifold.points.empty()) << step;
    }
    if (overlap > 1e-6) {
      ASSERT_EQ(manifold.points.size(), 8u) << step;
      ASSERT_GT(manifold.normal.y(), S(0.9999));
      ASSERT_LT(deepest(manifold), before);
      before = deepest(manifold);
    }
  }
}

}  // namespace
}  // namespace contactscope

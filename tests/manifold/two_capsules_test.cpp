#include "manifold/fast/fast_pairs.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "manifold/placed_shapes.h"
#include "support/builders.h"

// The special path of two capsules gives the general path's result, bit for bit, or none.
namespace contactscope {
namespace {

using test::PlacedShapes;
using test::Random;

/// Zeros of either sign are equal.
template <class S> void expect_same_bits(S one, S other) {
  one += S(0);
  other += S(0);
  EXPECT_EQ(std::memcmp(&one, &other, sizeof one), 0) << one << " for " << other;
}

/// Number of results of the special path: with a manifold, or separated.
struct Done {
  int pairs = 0, touching = 0, distance = 0;
};

template <class S>
void expect_general(const PlacedShapes& pair, const CollideOptions& options, Done& done) {
  const Shape<S> a = shape_cast<S>(pair.a), b = shape_cast<S>(pair.b);
  const Pose<S> pose_a = pair.pose_a.cast<S>(), pose_b = pair.pose_b.cast<S>();
  ++done.pairs;
  Manifolds<S> alone(1), general;  // the contents of an earlier call must not matter
  if (!collide_two_capsules(*std::get_if<Capsule<S>>(&a), pose_a, *std::get_if<Capsule<S>>(&b),
                            pose_b, options, alone))
    return;
  trace::Pair record;  // forces the general path
  collide(a, pose_a, b, pose_b, options, general, nullptr, &record);
  ASSERT_EQ(alone.size(), general.size());
  ++(alone.empty() ? done.distance : done.touching);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(alone[i].axis, general[i].axis);
    EXPECT_EQ(alone[i].type, general[i].type);
    EXPECT_EQ(alone[i].triangle, general[i].triangle);
    for (int k = 0; k < 3; ++k) expect_same_bits(alone[i].normal[k], general[i].normal[k]);
    ASSERT_EQ(alone[i].points.size(), general[i].points.size());
    for (std::size_t p = 0; p < alone[i].points.size(); ++p) {
      const ContactPoint<S>&point = alone[i].points[p], &expected = general[i].points[p];
      EXPECT_EQ(to_string(point.id), to_string(expected.id));
      for (int k = 0; k < 3; ++k) expect_same_bits(point.position[k], expected.position[k]);
      expect_same_bits(point.separation, expected.separation);
    }
  }
}

Capsule<double> any_capsule(Random& random, double size, double radius) {
  const Vec3d middle = (random.chance(0.5) ? 0 : size) * random.vector(-1, 1);
  const Vec3d half = size * random.decade(-1, 0) * random.unit_vector();
  return {{middle - half, middle + half}, radius};
}

/// A pair whose ends, axes or middles are near each other, by `gap` of the radii.
PlacedShapes any_pair(Random& random) {
  const double size = random.decade(-4, 4);
  const double radius = size * random.decade(-2, 0);
  PlacedShapes pair;
  const Capsule<double> a = any_capsule(random, size, radius);
  const Capsule<double> b =
      random.chance(0.5) ? a : any_capsule(random, size, radius * random.decade(-1, 1));
  pair.a = a;
  pair.b = b;
  pair.pose_a = random.pose(size);
  pair.pose_b.rotation = random.rotation();
  const auto place = [&](const Capsule<double>& capsule) {
    const double parameter = random.chance(0.5) ? random.index(2) : random.uniform(-0.1, 1.1);
    return Vec3d(capsule.points[0] + parameter * (capsule.points[1] - capsule.points[0]));
  };
  const double gap = random.chance(0.2) ? 0 : random.uniform(0, 1.2) * (a.radius + b.radius);
  pair.pose_b.position =
      pair.pose_a.transform(place(a)) - pair.pose_b.rotate(place(b)) + gap * random.unit_vector();
  return pair;
}

template <class S> class TwoCapsules : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TwoCapsules, Scalars);

TYPED_TEST(TwoCapsules, AnyPairIsAsTheGeneralPathHasIt) {
  Random random(51);
  Done done;
  for (int i = 0; i < 30000; ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    CollideOptions options;
    options.b_first = random.chance(0.5);
    const PlacedShapes pair = any_pair(random);
    if (random.chance(0.3)) options.margin = std::get<Capsule<double>>(pair.a).radius * 0.3;
    if (random.chance(0.5)) options.reducer = find_reducer("area");
    ASSERT_NO_FATAL_FAILURE(expect_general<TypeParam>(pair, options, done));
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(done.touching, 0.2 * done.pairs);
  EXPECT_GT(done.distance, 0.02 * done.pairs);
}

// The closest points change from an end to the axis, from axis to axis, and near parallel.
TYPED_TEST(TwoCapsules, SlowPairsAtTheLimitOfEveryCaseAreAsTheGeneralPathHasThem) {
  Random random(52);
  Done done;
  const double parameters[] = {0, 1, 0.5, 0.25, 1};
  const double sines[] = {0, 1e-7, 0.05, 0.0999, 0.1, 0.1001, 0.14, 0.1415, 0.5, 1};
  for (int i = 0; i < 100000; ++i) {
    SCOPED_TRACE("pair " + std::to_string(i));
    const double size = random.chance(0.5) ? 1 : random.decade(-4, 4);
    const double nudge = random.chance(0.3) ? 0 : random.decade(-9, -1);
    const double long_b = random.chance(0.5) ? 1 : random.decade(-2, 2);
    PlacedShapes pair{test::lying_capsule(size, 0.4 * size),
                      {},
                      test::lying_capsule(size * long_b, 0.4 * size),
                      {}};
    const double turn = std::asin(sines[random.index(10)]) + nudge * random.uniform(-1, 1);
    pair.pose_b.rotation =
        test::about(Vec3d::UnitY(), turn + (random.chance(0.5) ? 0 : 3.14159265));
    const auto along = [&](double half) {
      const double parameter = parameters[random.index(5)] + nudge * random.uniform(-1, 1);
      return Vec3d((2 * parameter - 1) * half, 0, 0);
    };
    Vec3d offset(0, random.uniform(0.1, 0.9), 0);
    if (random.chance(0.5)) offset += random.uniform(-0.5, 0.5) * Vec3d(1, 0, 0);
    pair.pose_b.position = along(size) + size * offset - pair.pose_b.rotate(along(size * long_b));
    if (random.chance(0.7)) pair = test::moved(pair, random.pose(random.chance(0.5) ? 0 : size));
    ASSERT_NO_FATAL_FAILURE(expect_general<TypeParam>(pair, {}, done));
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(done.touching, 0.02 * done.pairs);
}

TYPED_TEST(TwoCapsules, NothingOddIsDoneByItself) {
  using S = TypeParam;
  const auto done = [](const PlacedShapes& pair) {
    Done result;
    expect_general<S>(pair, {}, result);
    return result.touching + result.distance > 0;
  };
  const PlacedShapes cross{test::lying_capsule(1, 0.5),
                           {},
                           test::upright_capsule(1, 0.5),
                           {Quatd::Identity(), Vec3d(1.2, 1.2, 0.7)}};
  EXPECT_TRUE(done(cross));
  PlacedShapes odd = cross;
  odd.pose_b.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(done(odd));
  odd.pose_b.position.x() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(done(odd));
  odd = cross;
  odd.b = test::upright_capsule(0, 0.5);
  EXPECT_FALSE(done(odd)) << "no length";
  odd = cross;
  odd.b = test::lying_capsule(1, 0.5);
  EXPECT_FALSE(done(odd)) << "parallel";
  odd = cross;
  odd.pose_b.position = Vec3d(1, 1, 0);
  EXPECT_FALSE(done(odd)) << "axes that meet at their ends";
  odd.pose_b.position = Vec3d(0, 0, 0.5);
  EXPECT_FALSE(done(odd)) << "axes that cross beside each other";
}

}  // namespace
}  // namespace contactscope

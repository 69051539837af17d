#include "query/overlap.h"

#include <gmock/gmock.h>

#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;

template <class S> class Overlap : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Overlap, Scalars);

template <class S> BoundingSphere<S> ball(double x, double y, double z, double radius) {
  return {Vec3d(x, y, z).cast<S>(), static_cast<S>(radius)};
}

template <class S> Aabb<S> cube_at(double x, double y, double z, double half) {
  const Vec3d middle(x, y, z), reach = Vec3d::Constant(half);
  return {Vec3d(middle - reach).cast<S>(), Vec3d(middle + reach).cast<S>()};
}

template <class S> Obb<S> oriented_cube_at(double x) {
  return {Vec3d(x, 0.5, 0).cast<S>(), Mat3<S>::Identity(), Vec3<S>::Ones()};
}

/// Results of the inclusive and exclusive tests and of the one within 0.25.
template <class S, class A, class B> std::array<bool, 3> answers(const A& a, const B& b) {
  return {overlaps(a, b, Comparison<S>::inclusive()), overlaps(a, b, Comparison<S>::exclusive()),
          overlaps(a, b, Comparison<S>::within(S(0.25)))};
}

constexpr std::array<bool, 3> kDeep = {true, true, true}, kTouching = {true, false, true},
                              kNear = {false, false, true}, kFar = {false, false, false};

TYPED_TEST(Overlap, AllBoundsAreComparedAlike) {
  using S = TypeParam;
  const Aabb<S> box = cube_at<S>(0, 0, 0, 1);
  const Obb<S> oriented{Vec3<S>::Zero(), Mat3<S>::Identity(), Vec3<S>::Ones()};
  const BoundingSphere<S> sphere = ball<S>(0, 0, 0, 1);
  const struct {
    double x;
    std::array<bool, 3> expected;
  } kCases[] = {{1.75, kDeep}, {2, kTouching}, {2.125, kNear}, {2.25, kNear}, {2.5, kFar}};
  for (const auto& [x, expected] : kCases) {
    const Aabb<S> other_box = cube_at<S>(x, 0.5, 0, 1);
    const BoundingSphere<S> other = ball<S>(x, 0, 0, 1);
    EXPECT_EQ((answers<S>(box, other_box)), expected) << x;
    EXPECT_EQ((answers<S>(oriented, oriented_cube_at<S>(x))), expected) << x;
    EXPECT_EQ((answers<S>(sphere, other)), expected) << x;
  }
}

TYPED_TEST(Overlap, AabbsCompareTheirCoordinatesExactly) {
  using S = TypeParam;
  Random random(1);
  for (int trial = 0; trial < 3000; ++trial) {
    const double size = random.decade(-4, 4);
    const auto coordinate = [&] { return static_cast<S>(size * random.index(5)); };
    Aabb<S> a, b;
    for (Aabb<S>* box : {&a, &b}) {
      box->include({coordinate(), coordinate(), coordinate()});
      box->include({coordinate(), coordinate(), coordinate()});
    }
    bool inclusive = true, exclusive = true;
    for (int k = 0; k < 3; ++k) {
      inclusive &= a.lower[k] <= b.upper[k] && b.lower[k] <= a.upper[k];
      exclusive &= a.lower[k] < b.upper[k] && b.lower[k] < a.upper[k];
    }
    OverlapRecord<S> record;
    EXPECT_EQ(overlaps(a, b, Comparison<S>::inclusive(), &record), inclusive);
    EXPECT_EQ(overlaps(a, b, Comparison<S>::inclusive()), overlaps(a, b));
    EXPECT_EQ(overlaps(a, b, Comparison<S>::exclusive()), exclusive);
    ASSERT_EQ(record.axes.size(), 3u);
    S largest = -std::numeric_limits<S>::infinity();
    for (const OverlapAxis<S>& axis : record.axes) largest = std::max(largest, axis.gap);
    EXPECT_EQ(largest <= 0, inclusive);
  }
}

TYPED_TEST(Overlap, SpheresAreRightAtEverySizeAndFarAway) {
  using S = TypeParam;
  Random random(3);
  for (int trial = 0; trial < 5000; ++trial) {
    const double size = random.decade(-4, 4);
    const Vec3d at = 1000 * size * random.unit_vector();
    BoundingSphere<S> a{at.cast<S>(), S(size * random.decade(-2, 0))};
    BoundingSphere<S> b{(at + size * random.unit_vector()).cast<S>(), 0};
    const long double distance =
        (b.center.template cast<long double>() - a.center.template cast<long double>()).norm();
    b.radius = S(
        std::max(0.0L, distance * (1 + random.uniform(-1, 1) * random.decade(-16, 0)) - a.radius));
    const double gap = double(distance - a.radius - b.radius);
    const double unit = std::numeric_limits<S>::epsilon() * double(distance + a.radius + b.radius);
    OverlapRecord<S> record;
    const bool inclusive = overlaps(a, b, Comparison<S>::inclusive(), &record);
    if (gap <= 0) {
      EXPECT_TRUE(inclusive);
    }
    if (gap > 48 * unit) {
      EXPECT_FALSE(inclusive);
    }
    if (gap >= 0) {
      EXPECT_FALSE(overlaps(a, b, Comparison<S>::exclusive()));
    }
    if (gap < -48 * unit) {
      EXPECT_TRUE(overlaps(a, b, Comparison<S>::exclusive()));
    }
    ASSERT_EQ(record.axes.size(), 1u);
    EXPECT_NEAR(record.axes[0].gap, gap, 16 * unit);
    EXPECT_EQ(record.axes[0].separates, !inclusive);
    EXPECT_EQ(overlaps(b, a, Comparison<S>::inclusive()), inclusive);
  }
}

TYPED_TEST(Overlap, EmptyBoundsAndNanOverlapNothingAndLeaveTheRecordEmpty) {
  using S = TypeParam;
  const S nan = std::numeric_limits<S>::quiet_NaN();
  const Aabb<S> box = cube_at<S>(0, 0, 0, 1);
  const BoundingSphere<S> sphere = ball<S>(0, 0, 0, 1);
  Aabb<S> nan_box = box;
  nan_box.upper.y() = nan;
  BoundingSphere<S> nan_center = sphere, nan_radius = sphere;
  nan_center.center.z() = nan;
  nan_radius.radius = nan;
  OverlapRecord<S> record;
  const auto expect_nothing = [&](const auto& a, const auto& b) {
    for (const auto& comparison :
         {Comparison<S>::inclusive(), Comparison<S>::exclusive(), Comparison<S>::within(S(1))}) {
      record.axes.resize(1);
      EXPECT_FALSE(overlaps(a, b, comparison, &record));
      EXPECT_THAT(record.axes, testing::IsEmpty());
      EXPECT_FALSE(overlaps(a, b, comparison));
    }
  };
  for (const Aabb<S>& bad : {Aabb<S>{}, nan_box}) {
    expect_nothing(bad, box);
    expect_nothing(box, bad);
  }
  for (const BoundingSphere<S>& bad : {BoundingSphere<S>{}, nan_center, nan_radius}) {
    expect_nothing(bad, sphere);
    expect_nothing(sphere, bad);
  }
}

}  // namespace
}  // namespace contactscope

#include "geometry/aabb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

using Box = Aabb<double>;

const Box kUnit{Vec3d(0, 0, 0), Vec3d(1, 1, 1)};

template <class Part> Box grown(Box box, const Part& part) {
  box.include(part);
  return box;
}

TEST(Aabb, BoxesThatTouchInAFaceAnEdgeOrACornerOverlap) {
  EXPECT_TRUE(overlaps(kUnit, Box{Vec3d(1, 0, 0), Vec3d(2, 1, 1)}));
  EXPECT_TRUE(overlaps(kUnit, Box{Vec3d(1, -1, 0), Vec3d(2, 0, 1)}));
  EXPECT_TRUE(overlaps(kUnit, Box{Vec3d(-1, -1, -1), Vec3d(0, 0, 0)}));
}

TEST(Aabb, AGapAlongOneAxisIsEnough) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double shift : {1.0000001, -1.0000001}) {
      const Vec3d by = shift * Vec3d::Unit(axis);
      const Box other{kUnit.lower + by, kUnit.upper + by};
      EXPECT_FALSE(overlaps(kUnit, other)) << axis;
      EXPECT_FALSE(overlaps(other, kUnit)) << axis;
    }
  }
}

// Traces are compared byte for byte, and a flat mesh has zeros of both signs.
template <class S> void expect_first_zero_stays() {
  const Vec3<S> zero = Vec3<S>::Zero(), minus_zero = -zero;
  Aabb<S> box{zero, minus_zero};
  box.include(minus_zero);
  box.include(zero);
  box.include(Aabb<S>{minus_zero, zero});
  for (int k = 0; k < 3; ++k) {
    EXPECT_FALSE(std::signbit(box.lower[k])) << k;
    EXPECT_TRUE(std::signbit(box.upper[k])) << k;
  }
}
TEST(Aabb, TheFirstOfTwoZerosIsKept) {
  expect_first_zero_stays<float>();
  expect_first_zero_stays<double>();
}

template <class S> void expect_queried_as_overlaps() {
  Random random(7);
  const S numbers[] = {0,
                       1,
                       2,
                       3,
                       std::numeric_limits<S>::infinity(),
                       -std::numeric_limits<S>::infinity(),
                       std::numeric_limits<S>::quiet_NaN()};
  const auto draw = [&] {
    Aabb<S> box;
    const int odd = random.chance(0.3) ? 7 : 4;
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = numbers[random.index(odd)];
      box.upper[k] = numbers[random.index(odd)];
    }
    return box;
  };
  int overlapping = 0;
  for (int i = 0; i < 20000; ++i) {
    const Aabb<S> one = draw(), other = draw();
    ASSERT_EQ(OverlapsWith<S>(one)(other), overlaps(one, other)) << i;
    overlapping += overlaps(one, other) ? 1 : 0;
  }
  EXPECT_GT(overlapping, 500);
}

TEST(Aabb, ABatchedOverlapTestMatchesSingleTests) {
  expect_queried_as_overlaps<float>();
  expect_queried_as_overlaps<double>();
}

TEST(Aabb, ABoxInsideAnotherOverlapsAndAddsNothing) {
  const Box inner{Vec3d(0.2, 0.2, 0.2), Vec3d(0.3, 1, 0.3)};
  EXPECT_TRUE(overlaps(kUnit, inner));
  EXPECT_EQ(grown(kUnit, inner), kUnit);
  EXPECT_EQ(grown(inner, kUnit), kUnit);
  EXPECT_EQ(grown(kUnit, Vec3d(1, 0, 0.5)), kUnit);
  EXPECT_NE(grown(kUnit, Vec3d(1.1, 0, 0.5)), kUnit);
}

TEST(Aabb, TheEmptyBoxOverlapsNothingAndMergesIntoTheOther) {
  const Box empty;
  EXPECT_TRUE(empty.empty());
  EXPECT_FALSE(kUnit.empty());
  EXPECT_FALSE(overlaps(empty, kUnit));
  EXPECT_FALSE(overlaps(empty, empty));
  EXPECT_EQ(grown(empty, kUnit), kUnit);
  EXPECT_EQ(grown(kUnit, empty), kUnit);
  EXPECT_EQ(surface_area(empty), 0);
}

TEST(Aabb, ABoxWithNanOverlapsNothing) {
  for (int axis = 0; axis < 3; ++axis) {
    Box bad = kUnit;
    bad.lower[axis] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(bad.empty());
    EXPECT_FALSE(overlaps(bad, kUnit));
    EXPECT_FALSE(overlaps(kUnit, bad));
  }
}

TEST(Aabb, SurfaceAreaCountsAllSixSides) {
  EXPECT_EQ(surface_area(Box{Vec3d(1, 1, 1), Vec3d(2, 3, 4)}), 2 * (2 + 6 + 3));
  EXPECT_EQ(surface_area(Box{Vec3d(1, 1, 1), Vec3d(1, 3, 4)}), 2 * 6);  // flat
}

TEST(Aabb, MergingHoldsBothAndNoMore) {
  EXPECT_EQ(grown(kUnit, Box{Vec3d(-1, 0.5, 2), Vec3d(0, 0.6, 3)}),
            (Box{Vec3d(-1, 0, 0), Vec3d(1, 1, 3)}));
}

TEST(Aabb, ARoundedBoxIsTheBoxOfTheRoundedPoints) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    Box box;
    Aabb<float> rounded;
    for (int k = 0; k < 5; ++k) {
      const Vec3d point = random.decade(-4, 4) * random.unit_vector();
      box.include(point);
      rounded.include(Vec3f(point.cast<float>()));
    }
    EXPECT_EQ(box.cast<float>(), rounded);
  }
}

}  // namespace
}  // namespace contactscope::test

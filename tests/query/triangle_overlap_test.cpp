#include "query/triangle_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <type_traits>

#include "support/exact_triangles.h"
#include "support/random_triangles.h"

namespace contactscope {
namespace {

using enum TriangleOverlapKind;
using test::ExactOverlap;
using test::Random;
using test::TrianglePair;
using test::TrianglePairs;

const Triangle<double> kFloor{Vec3d(0, 0, 0), Vec3d(4, 0, 0), Vec3d(0, 4, 0)};

void expect_segment(const TriangleOverlap<double>& overlap, const Vec3d& a, const Vec3d& b) {
  const auto& [from, to] = overlap.segment;
  EXPECT_TRUE((from == a && to == b) || (from == b && to == a))
      << from.transpose() << " to " << to.transpose();
}

TEST(TriangleOverlap, InteriorsThatCrossAreProper) {
  const TriangleOverlap<double> overlap =
      triangle_overlap<double>(kFloor, {Vec3d(1, 1, -1), Vec3d(2, 1, 1), Vec3d(0, 1, 1)});
  EXPECT_EQ(overlap.kind, Proper);
  expect_segment(overlap, Vec3d(0.5, 1, 0), Vec3d(1.5, 1, 0));
}

TEST(TriangleOverlap, ACornerOnTheOtherTouches) {
  const TriangleOverlap<double> overlap =
      triangle_overlap<double>(kFloor, {Vec3d(1, 1, 0), Vec3d(2, 1, 1), Vec3d(0, 1, 1)});
  EXPECT_EQ(overlap.kind, Touching);
  expect_segment(overlap, Vec3d(1, 1, 0), Vec3d(1, 1, 0));
}

TEST(TriangleOverlap, AnEdgeThatRestsOnTheOtherTouches) {
  const TriangleOverlap<double> overlap =
      triangle_overlap<double>(kFloor, {Vec3d(1, 1, 0), Vec3d(5, 1, 0), Vec3d(1, 1, 3)});
  EXPECT_EQ(overlap.kind, Touching);
  expect_segment(overlap, Vec3d(1, 1, 0), Vec3d(3, 1, 0));
}

TEST(TriangleOverlap, NeighboursTouchInTheirEdge) {
  const TriangleOverlap<double> overlap =
      triangle_overlap<double>(kFloor, {Vec3d(4, 0, 0), Vec3d(0, 0, 0), Vec3d(0, 0, 4)});
  EXPECT_EQ(overlap.kind, Touching);
  expect_segment(overlap, Vec3d(0, 0, 0), Vec3d(4, 0, 0));
}

TEST(TriangleOverlap, ASharedAreaIsCoplanar) {
  const TriangleOverlap<double> overlap =
      triangle_overlap<double>(kFloor, {Vec3d(1, 1, 0), Vec3d(5, 1, 0), Vec3d(1, 5, 0)});
  EXPECT_EQ(overlap.kind, Coplanar);
  EXPECT_FALSE(overlap.a_degenerate || overlap.b_degenerate);
  EXPECT_EQ(triangle_overlap<double>(kFloor, kFloor).kind, Coplanar);
}

TEST(TriangleOverlap, NeighboursInOnePlaneTouch) {
  const TriangleOverlap<double> overlap =
      triangle_overlap<double>(kFloor, {Vec3d(1, 0, 0), Vec3d(9, 0, 0), Vec3d(1, -5, 0)});
  EXPECT_EQ(overlap.kind, Touching);
  expect_segment(overlap, Vec3d(1, 0, 0), Vec3d(4, 0, 0));
}

TEST(TriangleOverlap, ANeedleThroughATriangleTouches) {
  const TriangleOverlap<double> overlap =
      triangle_overlap<double>(kFloor, {Vec3d(1, 1, 1), Vec3d(1, 1, 3), Vec3d(1, 1, -1)});
  EXPECT_EQ(overlap.kind, Touching);
  EXPECT_FALSE(overlap.a_degenerate);
  EXPECT_TRUE(overlap.b_degenerate);
  expect_segment(overlap, Vec3d(1, 1, 0), Vec3d(1, 1, 0));
}

TEST(TriangleOverlap, PointsTouchWhereTheyAreEqual) {
  const Vec3d p(1, 2, 3);
  const TriangleOverlap<double> overlap = triangle_overlap<double>({p, p, p}, {p, p, p});
  EXPECT_EQ(overlap.kind, Touching);
  EXPECT_TRUE(overlap.a_degenerate && overlap.b_degenerate);
  expect_segment(overlap, p, p);
  EXPECT_EQ(triangle_overlap_kind<double>({p, p, p}, {2 * p, 2 * p, 2 * p}), None);
  EXPECT_TRUE(is_degenerate<double>({p, p, p}));
  EXPECT_FALSE(is_degenerate<double>(kFloor));
}

TEST(TriangleOverlap, OneLastBitDecides) {
  const double gap = 0x1p-52;
  const auto above = [](double height) -> Triangle<double> {
    return {Vec3d(1, 1, height), Vec3d(2, 1, 2), Vec3d(0, 1, 2)};
  };
  const auto at_one = [](double height) -> Triangle<double> {
    return {Vec3d(0, 0, height), Vec3d(4, 0, height), Vec3d(0, 4, height)};
  };
  EXPECT_EQ(triangle_overlap_kind(at_one(1), above(1)), Touching);
  EXPECT_EQ(triangle_overlap_kind(at_one(1), above(1 + gap)), None);
  EXPECT_EQ(triangle_overlap_kind(at_one(1), above(1 - gap)), Proper);
}

/// Compares the ends of the segment with the oracle's, in either order.
void expect_near(const std::array<Vec3d, 2>& segment, const std::array<Vec3d, 2>& expected,
                 double tolerance, const std::string& where) {
  const auto separated = [&](std::size_t i, std::size_t j) {
    return (segment[0] - expected[i]).norm() + (segment[1] - expected[j]).norm();
  };
  ASSERT_LE(std::min(separated(0, 1), separated(1, 0)), tolerance) << where;
}

template <class S>
void agrees(const TrianglePair& pair, const ExactOverlap& expected, double size, double far,
            const std::string& where) {
  const Triangle<S> a = test::rounded<S>(pair.first), b = test::rounded<S>(pair.second);
  const TriangleOverlap<S> overlap = triangle_overlap(a, b);
  ASSERT_EQ(overlap.kind, expected.kind) << where;
  ASSERT_EQ(triangle_overlap_kind(b, a), expected.kind) << where;
  if (expected.kind == None || expected.kind == Coplanar) return;
  ASSERT_EQ(overlap.a_degenerate, is_degenerate(a)) << where;
  ASSERT_EQ(overlap.b_degenerate, is_degenerate(b)) << where;
  // Edges are up to ten sizes long on the grid.
  const double tolerance =
      0x1p-30 * 20 * size + 16 * std::numeric_limits<S>::epsilon() * (4 * size + far);
  expect_near(
      {overlap.segment[0].template cast<double>(), overlap.segment[1].template cast<double>()},
      expected.ends(), tolerance, where);
}

/// Tries all kinds of pairs at every scale. Returns the number of each kind of overlap.
template <class S> std::map<TriangleOverlapKind, int> compare_with_oracle(int count) {
  constexpr bool kInFloat = std::is_same_v<S, float>;
  Random random(kInFloat ? 21 : 22);
  std::map<TriangleOverlapKind, int> kinds;
  for (int i = 0; i < count; ++i) {
    const auto how = static_cast<TrianglePairs>(random.index(test::kTrianglePairs));
    const double size = random.chance(0.5) ? std::ldexp(1, random.index(27) - 13)  // 1e-4 to 1e4
                                           : random.decade(-4, 4);
    const double far = random.chance(0.3) ? 1000 * size : 0;
    const TrianglePair pair =
        test::random_triangle_pair(random, how, size, far * random.unit_vector(), kInFloat);
    const ExactOverlap expected = test::exact_triangle_overlap(pair.first, pair.second);
    ++kinds[expected.kind];
    agrees<S>(pair, expected, size, far,
              "pair " + std::to_string(i) + " made as " + std::to_string(static_cast<int>(how)));
    if (testing::Test::HasFatalFailure()) break;
  }
  return kinds;
}

TEST(TriangleOverlap, SlowFloatsAgreeWithExactClipping) {
  for (const auto& [kind, count] : compare_with_oracle<float>(20000)) EXPECT_GT(count, 400);
}

TEST(TriangleOverlap, SlowDoublesAgreeWithExactClipping) {
  for (const auto& [kind, count] : compare_with_oracle<double>(20000)) EXPECT_GT(count, 400);
}

TEST(TriangleOverlap, NoOrderOfCornersChangesTheKind) {
  Random random(23);
  for (int i = 0; i < 3000; ++i) {
    const auto how = static_cast<TrianglePairs>(random.index(test::kTrianglePairs));
    const auto [a, b] = test::random_triangle_pair(random, how, 1, Vec3d::Zero(), false);
    const TriangleOverlapKind kind = triangle_overlap_kind(a, b);
    EXPECT_EQ(triangle_overlap_kind<double>({a[1], a[2], a[0]}, {b[1], b[0], b[2]}), kind);
    EXPECT_EQ(triangle_overlap_kind<double>({b[2], b[1], b[0]}, {a[0], a[2], a[1]}), kind);
  }
}

TEST(TriangleOverlap, BothTrianglesAtAnEdgeEndOnTheSamePoint) {
  // A wall through the common edge of two floor triangles.
  Random random(24);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto [wall, left] =
        test::random_triangle_pair(random, TrianglePairs::Random, 1, Vec3d::Zero(), false);
    const Vec3d fourth = left[0] + left[1] - left[2] + 0.3 * random.unit_vector();
    const TriangleOverlap<double> l = triangle_overlap<double>(wall, left);
    const TriangleOverlap<double> r = triangle_overlap<double>(wall, {left[1], left[0], fourth});
    const TriangleOverlap<double> needle =
        triangle_overlap<double>(wall, {left[0], left[1], left[1]});
    if (l.kind != Proper || r.kind != Proper || needle.kind == None) continue;
    ++met;
    const auto [from, to] = r.segment;
    EXPECT_TRUE(l.segment[0] == from || l.segment[0] == to || l.segment[1] == from ||
                l.segment[1] == to)
        << i;
  }
  EXPECT_GT(met, 50);
}

}  // namespace
}  // namespace contactscope

#include "query/capsule_sat.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "geometry/primitives.h"
#include "query/tolerance.h"
#include "support/minkowski_face.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;

constexpr double kNoReach = std::numeric_limits<double>::infinity();

double gap_along(const Hull<double>& hull, const Vec3d (&ends)[2], const Vec3d& direction) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Vec3d& vertex : hull.vertices) top = std::max(top, direction.dot(vertex));
  return std::min(direction.dot(ends[0]), direction.dot(ends[1])) - top;
}

/// The best separation over all edges: every cross product, with both signs.
double best_edge_gap(const Hull<double>& hull, const Vec3d (&ends)[2]) {
  double best = -std::numeric_limits<double>::infinity();
  for (int e = 0; e < hull.edge_count(); ++e) {
    const Vec3d edge = hull.target(2 * e) - hull.origin(2 * e);
    const Vec3d cross = edge.cross(ends[1] - ends[0]);
    if (cross.norm() < 1e-9 * edge.norm() * (ends[1] - ends[0]).norm()) continue;
    const Vec3d axis = cross.normalized();
    best = std::max({best, gap_along(hull, ends, axis), gap_along(hull, ends, -axis)});
  }
  return best;
}

TEST(CapsuleSat, SegmentAcrossABoxEdgeHasTheAxisOfBoth) {
  const Hull<double> box = make_box(Vec3d(1, 1, 1));
  // Across the edge x = y = 1, perpendicular to it and to the diagonal, 0.1 deep.
  const Vec3d diagonal = Vec3d(1, 1, 0).normalized();
  const Vec3d middle = Vec3d(1, 1, 0.2) - 0.1 * diagonal;
  const Vec3d along = Vec3d(1, -1, 0);
  const Vec3d ends[2] = {middle - 3 * along, middle + 3 * along};
  const CapsuleSat<double> axes = capsule_sat(box, ends, kNoReach, 1e-12);
  ASSERT_TRUE(axes.edge_wins());
  EXPECT_NEAR(axes.separation(), -0.1, 1e-14);
  EXPECT_LT((axes.edge_normal - diagonal).norm(), 1e-14);
  EXPECT_NEAR(std::abs((box.target(axes.edge) - box.origin(axes.edge)).z()), 2, 0);
}

TEST(CapsuleSat, SegmentAcrossABoxEdgeIsMeasuredAlikeFromEitherEnd) {
  const Hull<double> box = make_box(Vec3d(1, 1, 1));
  const Vec3d from(3, -0.9, 0.2), to(-0.8, 3, -0.1);
  const Vec3d there[2] = {from, to};
  const Vec3d back[2] = {to, from};
  const CapsuleSat<double> one = capsule_sat(box, there, kNoReach, 1e-12);
  const CapsuleSat<double> other = capsule_sat(box, back, kNoReach, 1e-12);
  ASSERT_TRUE(one.edge_wins());
  EXPECT_EQ(one.edge, other.edge);
  EXPECT_NEAR(one.separation(), other.separation(), 1e-15);
  EXPECT_LT((one.edge_normal - other.edge_normal).norm(), 1e-15);
}

TEST(CapsuleSat, ParallelSegmentHasTheFaceAndNoEdge) {
  const Hull<double> box = make_box(Vec3d(1, 1, 1));
  const Vec3d ends[2] = {Vec3d(-0.5, 0.9, 0.1), Vec3d(0.5, 0.9, 0.1)};
  const CapsuleSat<double> axes = capsule_sat(box, ends, kNoReach, 1e-12);
  EXPECT_FALSE(axes.edge_wins());
  EXPECT_EQ(axes.face, 2);  // +y
  EXPECT_NEAR(axes.separation(), -0.1, 1e-15);
  EXPECT_FALSE(axes.face_tied);
}

TEST(CapsuleSat, SegmentThroughTheMiddleOfACubeIsTiedBetweenItsSides) {
  const Hull<double> box = make_box(Vec3d(1, 1, 1));
  const Vec3d ends[2] = {Vec3d(0, 0, -0.1), Vec3d(0, 0, 0.1)};
  const CapsuleSat<double> axes = capsule_sat(box, ends, kNoReach, 1e-12);
  EXPECT_EQ(axes.face, 0);  // the first one
  EXPECT_TRUE(axes.face_tied);
}

TEST(CapsuleSat, WithoutLengthItIsThatOfAPoint) {
  const Hull<double> box = make_box(Vec3d(1, 2, 3));
  const Vec3d point(0.5, 0.25, -2.75);
  const Vec3d ends[2] = {point, point};
  const CapsuleSat<double> axes = capsule_sat(box, ends, kNoReach, 1e-12);
  EXPECT_FALSE(axes.edge_wins());
  EXPECT_EQ(axes.face, 5);  // -z
  EXPECT_EQ(axes.separation(), -0.25);
}

TEST(CapsuleSat, FaceBeyondTheReachSparesTheEdges) {
  const Hull<double> box = make_box(Vec3d(1, 1, 1));
  const Vec3d ends[2] = {Vec3d(4, -1, 0.2), Vec3d(-1, 4, 0.2)};
  EXPECT_TRUE(capsule_sat(box, ends, 10.0, 1e-12).edge_wins());
  const Vec3d above[2] = {Vec3d(0.5, 3, 0), Vec3d(0, 3.1, 0.5)};
  const CapsuleSat<double> axes = capsule_sat(box, above, 1.0, 1e-12);
  EXPECT_FALSE(axes.edge_wins());
  EXPECT_EQ(axes.separation(), 2);
}

/// Axes outside the ring on the Gauss map never have the largest separation, and axes found by it
/// are true axes. In float and double, from needles to plates.
template <class S> void expect_best_axis(std::uint64_t seed) {
  Random random(seed);
  int edges = 0, overlaps = 0, gaps = 0;
  for (int i = 0; i < 5000; ++i) {
    SCOPED_TRACE(i);
    const double size = random.decade(-4, 4);
    const Hull<S> hull = hull_cast<S>(random_hull(random, 4 + random.index(61), size, 100));
    const Vec3<S>& corner = hull.vertices[static_cast<std::size_t>(random.index(4))];
    const Vec3d middle = random.uniform(0, 1.7) * corner.template cast<double>();
    const Vec3d half = random.decade(-2, 1) * size * random.unit_vector();
    const Vec3<S> ends[2] = {(middle - half).cast<S>(), (middle + half).cast<S>()};
    const double scale = size + middle.norm() + half.norm();
    const double rounding = std::numeric_limits<S>::epsilon() * scale;
    const CapsuleSat<S> axes =
        capsule_sat(hull, ends, std::numeric_limits<S>::infinity(), static_cast<S>(4 * rounding));

    const Hull<double> exact = hull_cast<double>(hull);
    const Vec3d exact_ends[2] = {ends[0].template cast<double>(), ends[1].template cast<double>()};
    double best = best_edge_gap(exact, exact_ends);
    double unevenness = 0;
    for (int f = 0; f < exact.face_count(); ++f) {
      const Plane<double>& plane = exact.planes[static_cast<std::size_t>(f)];
      best = std::max(best, std::min(plane.distance(exact_ends[0]), plane.distance(exact_ends[1])));
      for (const int v : face_vertices(exact, f)) {
        const double off = plane.distance(exact.vertices[static_cast<std::size_t>(v)]);
        unevenness = std::max(unevenness, std::abs(off));
      }
    }
    const double tolerance = 32 * rounding + 4 * unevenness;
    if (best < 0) {
      ASSERT_NEAR(axes.separation(), best, tolerance);
    } else {
      // If separated, a direction of no face of the Minkowski difference may give more.
      ASSERT_GE(axes.separation(), -tolerance);
      ASSERT_LE(axes.separation(), best + tolerance);
    }
    (best < 0 ? overlaps : gaps) += 1;
    if (!axes.edge_wins()) continue;
    ++edges;
    const Vec3d normal = axes.edge_normal.template cast<double>();
    ASSERT_NEAR(normal.norm(), 1, 8 * std::numeric_limits<S>::epsilon());
    ASSERT_NEAR(gap_along(exact, exact_ends, normal), axes.separation(), 32 * rounding);
  }
  EXPECT_GT(edges, 1000);
  EXPECT_GT(overlaps, 1000);
  EXPECT_GT(gaps, 500);
}

TEST(CapsuleSat, SlowFindsTheBestOfAllAxesInSinglePrecision) { expect_best_axis<float>(1); }
TEST(CapsuleSat, SlowFindsTheBestOfAllAxesInDoublePrecision) { expect_best_axis<double>(2); }

/// A segment is a hull with two faces that face both directions: its ring consists of all arcs
/// between n and -n. The pipeline's two signs agree with the talk's triple products.
TEST(CapsuleSat, RingCrossesTheArcsThatMakeAMinkowskiFaceWithTheSegment) {
  Random random(3);
  int crossings = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d a1 = random.unit_vector();
    const Vec3d a2 = (a1 + random.decade(-2, 0.5) * random.unit_vector()).normalized();
    const Vec3d along = random.unit_vector();
    const Vec3d edge = a1.cross(a2).normalized();
    // Two quarter arcs of the ring, on both sides of the direction perpendicular to both edges.
    const Vec3d axis = edge.cross(along).normalized();
    const Vec3d aside = along.cross(axis);
    const bool is_face =
        test::is_minkowski_face(a1, a2, -(axis + aside).normalized(),
                                -(axis - aside).normalized()) ||
        test::is_minkowski_face(a1, a2, (axis + aside).normalized(), (axis - aside).normalized());
    ASSERT_EQ(a1.dot(along) * a2.dot(along) < 0, is_face);
    crossings += is_face ? 1 : 0;
  }
  EXPECT_GT(crossings, 200);
}

}  // namespace
}  // namespace contactscope

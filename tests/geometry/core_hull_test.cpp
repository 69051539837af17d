#include "geometry/core_hull.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/hull_builder.h"
#include "geometry/hull_checks.h"
#include "geometry/primitives.h"
#include "support/cases.h"
#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

/// Extent of the intersection of the moved half-spaces. Every three planes meet in a point; its
/// vertices are the points that no plane cuts off. Uses no hull and no dual.
class MovedHalfSpaces {
 public:
  MovedHalfSpaces(const Hull<double>& hull, double margin) {
    const auto& planes = hull.planes;
    const double slack = 1e-9 * hull.radius;
    for (std::size_t i = 0; i < planes.size(); ++i)
      for (std::size_t j = i + 1; j < planes.size(); ++j)
        for (std::size_t k = j + 1; k < planes.size(); ++k) {
          Mat3<double> rows;
          rows << planes[i].normal.transpose(), planes[j].normal.transpose(),
              planes[k].normal.transpose();
          if (std::abs(rows.determinant()) < 1e-9) continue;
          const Vec3d offsets(planes[i].offset - margin, planes[j].offset - margin,
                              planes[k].offset - margin);
          const Vec3d point = rows.fullPivLu().solve(offsets);
          if (std::ranges::all_of(planes, [&](const Plane<double>& plane) {
                return plane.normal.dot(point) <= plane.offset - margin + slack;
              }))
            points_.push_back(point);
        }
  }
  double reach(const Vec3d& direction) const {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Vec3d& point : points_) farthest = std::max(farthest, direction.dot(point));
    return farthest;
  }

 private:
  std::vector<Vec3d> points_;
};

double reach(const Hull<double>& hull, const Vec3d& direction) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Vec3d& point : hull.vertices) farthest = std::max(farthest, direction.dot(point));
  return farthest;
}

TEST(CoreHull, ABoxGivesASmallerBoxWithTheSameFeatureIds) {
  const Hull<double> box = make_box(Vec3d(0.5, 0.25, 1.0));
  const CoreHull core = core_hull(box, 0.02);
  EXPECT_EQ(core.margin, 0.02);
  EXPECT_FALSE(core.reduced);
  const Hull<double> expected = make_box(Vec3d(0.48, 0.23, 0.98));
  ASSERT_EQ(core.hull.vertex_count(), 8);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(core.hull.vertices[static_cast<std::size_t>(i)],
              expected.vertices[static_cast<std::size_t>(i)]);
    EXPECT_EQ(core.vertices[static_cast<std::size_t>(i)], vertex_ref(Owner::A, i));
  }
  ASSERT_EQ(core.hull.edge_count(), 12);
  for (int i = 0; i < 12; ++i)
    EXPECT_EQ(core.edges[static_cast<std::size_t>(i)], edge_ref(Owner::A, i));
  for (int i = 0; i < 6; ++i)
    EXPECT_EQ(core.faces[static_cast<std::size_t>(i)], face_ref(Owner::A, i));
}

TEST(CoreHull, IsTheIntersectionOfTheMovedHalfSpaces) {
  Random random(3);
  for (int i = 0; i < test::cases(60); ++i) {
    const double size = random.decade(-4, 4);
    const Hull<double> hull = random_hull(random, 6 + random.index(10), size, 10);
    const CoreHull core = core_hull(hull, size * random.decade(-4, 0));
    ASSERT_GT(core.margin, 0) << i;
    EXPECT_TRUE(is_sound(core.hull)) << i;
    EXPECT_TRUE(is_convex(core.hull, 1e-5 * hull.radius)) << i;
    const MovedHalfSpaces oracle(hull, core.margin);
    for (int k = 0; k < 40; ++k) {
      const Vec3d direction = random.unit_vector();
      EXPECT_NEAR(reach(core.hull, direction), oracle.reach(direction), 1e-5 * hull.radius) << i;
    }
  }
}

TEST(CoreHull, ConesLoseNoFaceAndTheirEdgesStandForThoseOfTheCone) {
  // All sides of a regular cone meet in one point again, lower by margin / sin(half the opening).
  const Hull<double> cone = make_cone(0.5, 0.5, 24);
  const CoreHull core = core_hull(cone, 0.05);
  ASSERT_EQ(core.hull.face_count(), cone.face_count());
  ASSERT_EQ(core.hull.vertex_count(), cone.vertex_count());
  const double apothem = 0.5 * std::cos(std::acos(-1.0) / 24);
  const double sine = apothem / std::hypot(apothem, 1.0);
  EXPECT_NEAR(core.hull.vertices.back().y(), 0.5 - 0.05 / sine, 1e-12);
  for (int edge = 0; edge < core.hull.edge_count(); ++edge)
    EXPECT_EQ(core.edges[static_cast<std::size_t>(edge)], edge_ref(Owner::A, edge));
}

TEST(CoreHull, AnApexOfTwoSlopesBecomesARidgeThatStandsForIt) {
  // Sides of slope 1 over +-x and of slope 2 over +-z; the former move down faster.
  const std::vector<Vec3d> points{
      {1, 0, 0.5}, {1, 0, -0.5}, {-1, 0, 0.5}, {-1, 0, -0.5}, {0, 1, 0}};
  const CoreHull core = core_hull(build_hull(points), 0.05);
  ASSERT_EQ(core.hull.vertex_count(), 6);
  EXPECT_EQ(std::ranges::count(core.vertices, vertex_ref(Owner::A, 4)), 2);
  EXPECT_EQ(std::ranges::count(core.edges, vertex_ref(Owner::A, 4)), 1);
  std::vector<FeatureRef> edges = core.edges;
  std::ranges::sort(edges);
  EXPECT_EQ(std::ranges::adjacent_find(edges), edges.end());
}

TEST(CoreHull, AMarginThatLeavesNoCoreIsReduced) {
  const CoreHull core = core_hull(make_cylinder(1, 0.2, 12), 0.15);
  EXPECT_TRUE(core.reduced);
  EXPECT_NEAR(core.margin, kLargestCoreShare * 0.2, 1e-15);
  EXPECT_NEAR(reach(core.hull, Vec3d::UnitY()), 0.1, 1e-12);
}

TEST(CoreHull, WithoutAMarginItIsTheHull) {
  const Hull<double> box = make_box(Vec3d(1, 2, 3));
  const CoreHull core = core_hull(box, 0);
  EXPECT_EQ(core.hull.vertices, box.vertices);
  EXPECT_EQ(core.margin, 0);
  EXPECT_FALSE(core.reduced);
}

TEST(CoreHull, APlateOfATenThousandthKeepsItsSixFaces) {
  const CoreHull core = core_hull(make_box(Vec3d(128, 0.01, 128)), 0.004);
  ASSERT_EQ(core.hull.face_count(), 6);
  EXPECT_NEAR(reach(core.hull, Vec3d::UnitY()), 0.006, 1e-15);
  EXPECT_NEAR(reach(core.hull, Vec3d::UnitX()), 127.996, 1e-12);
}

}  // namespace
}  // namespace contactscope::test

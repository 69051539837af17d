#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/hull_builder.h"
#include "geometry/hull_checks.h"
#include "geometry/mesh.h"
#include "geometry/point_sets.h"
#include "geometry/primitives.h"

// Coplanar input must give the faces that a person sees, with or without rounding.
namespace contactscope::test {
namespace {

Points posed(Generator& random, const Points& points) {
  return rounded_to_float(transformed(points, random_rotation(random), 1, Vec3d(0.3, -0.2, 0.1)));
}

TEST(BuildHull, PointsOnFacesAndEdgesOfACubeAreLeftOut) {
  const Hull<double> hull = build_hull(box_grid(4));
  EXPECT_TRUE(is_sound(hull));
  EXPECT_TRUE(is_convex(hull, 1e-15));
  EXPECT_EQ(hull.vertex_count(), 8);
  EXPECT_EQ(face_sizes(hull), std::vector<int>(6, 4));
}

TEST(BuildHull, ATurnedGridInFloatIsACube) {
  Generator random(1);
  for (int i = 0; i < 100; ++i) {
    const Hull<double> hull = build_hull(posed(random, box_grid(1 + i % 5)));
    EXPECT_TRUE(is_sound(hull));
    EXPECT_EQ(face_sizes(hull), std::vector<int>(6, 4)) << i;
  }
}

TEST(BuildHull, ATurnedThinGridInFloatIsABox) {
  Generator random(2);
  for (int i = 0; i < 100; ++i) {
    Points points = box_grid(3);
    for (Vec3d& point : points) point.y() *= 1e-3;
    const Hull<double> hull = build_hull(posed(random, points));
    EXPECT_TRUE(is_sound(hull));
    EXPECT_EQ(face_sizes(hull), std::vector<int>(6, 4)) << i;
  }
}

TEST(BuildHull, ATurnedCylinderInFloatHasTwoCaps) {
  Generator random(3);
  for (const int segments : {3, 4, 5, 16, 63, 64, 128}) {
    const Points points = prism(segments);
    for (int i = 0; i < 10; ++i) {
      const Hull<double> hull = build_hull(posed(random, points));
      std::vector<int> expected(static_cast<std::size_t>(segments), 4);
      expected.insert(expected.end(), 2, segments);
      std::sort(expected.begin(), expected.end());
      EXPECT_TRUE(is_sound(hull));
      EXPECT_EQ(face_sizes(hull), expected);
    }
  }
}

TEST(BuildHull, ATurnedGlobeInFloatHasItsQuads) {
  Generator random(4);
  const int rings = 10;
  const int segments = 20;
  std::vector<int> expected(2 * segments, 3);
  expected.insert(expected.end(), (rings - 2) * segments, 4);
  for (int i = 0; i < 20; ++i) {
    const Hull<double> hull = build_hull(posed(random, globe(rings, segments)));
    EXPECT_TRUE(is_sound(hull));
    EXPECT_EQ(face_sizes(hull), expected);
  }
}

TEST(BuildHull, ABulgeAboveTheToleranceStays) {
  Points points = box_grid(1);
  const double tolerance = hull_tolerance(points);
  points.emplace_back(0, 0.5 + 100 * tolerance, 0);
  const Hull<double> hull = build_hull(points);
  EXPECT_TRUE(is_sound(hull));
  EXPECT_EQ(face_sizes(hull), (std::vector<int>{3, 3, 3, 3, 4, 4, 4, 4, 4}));
}

TEST(BuildHull, ABulgeBelowTheToleranceGoes) {
  Points points = box_grid(1);
  points.emplace_back(0, 0.5 + 0.5 * hull_tolerance(points), 0);
  EXPECT_EQ(face_sizes(build_hull(points)), std::vector<int>(6, 4));
}

TEST(BuildHull, AxisAlignedFacesAreExact) {
  const Hull<double> hull = build_hull(box_grid(1));
  for (const Plane<double>& plane : hull.planes) {
    EXPECT_EQ(plane.normal.cwiseAbs().maxCoeff(), 1);
    EXPECT_EQ(plane.normal.cwiseAbs().sum(), 1);
    EXPECT_EQ(plane.offset, 0.5);
  }
}

TEST(BuildHull, VerticesKeepTheOrderOfThePoints) {
  const Points points = {Vec3d(0, 0, 3), Vec3d(0.1, 0.1, 0.1), Vec3d(2, 0, 0), Vec3d(0, 1, 0),
                         Vec3d(0, 0, 0)};
  const Hull<double> hull = build_hull(points);
  EXPECT_EQ(hull.vertices, (Points{points[0], points[2], points[3], points[4]}));
}

TEST(BuildHull, CentroidOfATetrahedronIsTheMeanOfItsCorners) {
  Generator random(5);
  for (int i = 0; i < 20; ++i) {
    const Points points = in_ball(random, 4);
    const Vec3d mean = 0.25 * (points[0] + points[1] + points[2] + points[3]);
    const Hull<double> hull = build_hull(points);
    EXPECT_LT((hull.centroid - mean).norm(), 1e-12);
    double farthest = 0;
    for (const Vec3d& point : points) farthest = std::max(farthest, (point - mean).norm());
    EXPECT_NEAR(hull.radius, farthest, 1e-12);
  }
}

TEST(BuildHull, CentroidIsByVolumeAndNotByVertices) {
  // A pyramid, height 4, over a square whose corners are doubled by close neighbours.
  const Points points = {Vec3d(-1, 0, -1),    Vec3d(1, 0, -1), Vec3d(1, 0, 1),
                         Vec3d(-1, 0, 1),     Vec3d(0, 4, 0),  Vec3d(-1.001, 0, 0.9),
                         Vec3d(1.001, 0, 0.9)};
  const Hull<double> hull = build_hull(points);
  EXPECT_NEAR(hull.centroid.y(), 1, 1e-12);
  EXPECT_NEAR(hull.centroid.x(), 0, 1e-12);
}

Hull<double> unmerged(const Points& points) { return triangulate_faces(build_hull(points)); }

TEST(UnmergedHull, AGridIsACubeOfTwelveTriangles) {
  const Hull<double> hull = unmerged(box_grid(3));
  EXPECT_TRUE(is_sound(hull));
  EXPECT_TRUE(is_convex(hull, 1e-15));
  EXPECT_EQ(hull.vertex_count(), 8);
  EXPECT_EQ(face_sizes(hull), std::vector<int>(12, 3));
}

TEST(UnmergedHull, IsTheSameSolidAsTheMergedOne) {
  Generator random(6);
  for (int i = 0; i < 40; ++i) {
    const Points sets[] = {box_grid(1 + i % 3), prism(3 + i), globe(4 + i % 5, 8)};
    for (const Points& points : sets) {
      const Points noisy = posed(random, points);
      const Hull<double> merged = build_hull(noisy);
      const Hull<double> cut = unmerged(noisy);
      EXPECT_TRUE(is_sound(cut));
      EXPECT_TRUE(is_convex(cut, 10 * hull_tolerance(noisy)));
      EXPECT_EQ(cut.vertices, merged.vertices);
      EXPECT_EQ(cut.centroid, merged.centroid);
      EXPECT_EQ(cut.radius, merged.radius);
      EXPECT_NEAR(measure(cut).volume, measure(merged).volume, 1e-6);
      EXPECT_NEAR(measure(cut).area, measure(merged).area, 1e-5);
      std::size_t triangles = 0;
      for (const int size : face_sizes(merged)) triangles += static_cast<std::size_t>(size) - 2;
      EXPECT_EQ(face_sizes(cut), std::vector<int>(triangles, 3));
    }
  }
}

TEST(UnmergedHull, TrianglesOfOneFaceFollowEachOtherAndHaveItsPlane) {
  const Hull<double> cylinder = make_cylinder(0.4, 0.7, 9);
  const Hull<double> cut = triangulate_faces(cylinder);
  std::size_t at = 0;
  for (int face = 0; face < cylinder.face_count(); ++face) {
    const Plane<double>& plane = cylinder.planes[static_cast<std::size_t>(face)];
    for (std::size_t k = 2; k < face_vertices(cylinder, face).size(); ++k, ++at) {
      EXPECT_EQ(cut.planes[at].normal, plane.normal);
      EXPECT_EQ(cut.planes[at].offset, plane.offset);
    }
  }
  EXPECT_EQ(at, cut.planes.size());
}

TEST(UnmergedHull, WithNothingToMergeIsTheMergedHull) {
  Generator random(7);
  const Points points = on_sphere(random, 30);
  const Hull<double> merged = build_hull(points);
  const Hull<double> cut = unmerged(points);
  EXPECT_EQ(cut.face_edges, merged.face_edges);
  EXPECT_EQ(cut.lanes, merged.lanes);
}

TEST(UnmergedHull, LeavesAFaceWholeWhoseCutIsAnEdgeAlready) {
  // Two squares back to back; their first ears are at the two ends of one diagonal.
  const Hull<double> flat =
      hull_from_polygons({Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(1, 1, 0), Vec3d(0, 1, 0)},
                         {{0, 1, 2, 3}, {2, 1, 0, 3}});
  EXPECT_EQ(face_sizes(triangulate_faces(flat)), (std::vector<int>{3, 3, 4}));
}

}  // namespace
}  // namespace contactscope::test

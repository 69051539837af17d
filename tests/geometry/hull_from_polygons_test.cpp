#include "geometry/hull_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "geometry/hull_checks.h"
#include "geometry/point_sets.h"

namespace contactscope::test {
namespace {

using ::testing::HasSubstr;

using Faces = std::vector<std::vector<int>>;

const auto kNotClosed = HasSubstr("the faces of a hull bound one solid");

const Points kCorners = {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)};
const Faces kTetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

std::string refusal_of(const Points& vertices, const Faces& faces) {
  try {
    hull_from_polygons(vertices, faces);
  } catch (const ShapeError& error) {
    return error.what();
  }
  throw std::runtime_error("the polygons made a hull");
}

TEST(HullFromPolygons, ATetrahedronKeepsTheOrderOfItsParts) {
  const Hull<double> hull = hull_from_polygons(kCorners, kTetrahedron);
  EXPECT_TRUE(is_sound(hull));
  EXPECT_TRUE(is_convex(hull, 1e-15));
  EXPECT_EQ(hull.vertices, kCorners);
  for (int face = 0; face < 4; ++face) {
    EXPECT_EQ(face_vertices(hull, face), kTetrahedron[static_cast<std::size_t>(face)]);
  }
  EXPECT_LT((hull.centroid - Vec3d::Constant(0.25)).norm(), 1e-15);
  EXPECT_NEAR(measure(hull).volume, 1.0 / 6, 1e-15);
}

TEST(HullFromPolygons, RefusesAMissingFace) {
  EXPECT_THAT(refusal_of(kCorners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}}), kNotClosed);
}

TEST(HullFromPolygons, RefusesAFaceTurnedInsideOut) {
  EXPECT_THAT(refusal_of(kCorners, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}), kNotClosed);
}

TEST(HullFromPolygons, RefusesAnUnusedVertex) {
  Points vertices = kCorners;
  vertices.emplace_back(9, 9, 9);
  EXPECT_THAT(refusal_of(vertices, kTetrahedron), kNotClosed);
}

TEST(HullFromPolygons, RefusesTwoSolids) {
  Points vertices = kCorners;
  Faces faces = kTetrahedron;
  for (const Vec3d& corner : kCorners) vertices.emplace_back(corner + Vec3d(5, 5, 5));
  for (const std::vector<int>& face : kTetrahedron) {
    faces.push_back({face[0] + 4, face[1] + 4, face[2] + 4});
  }
  EXPECT_THAT(refusal_of(vertices, faces), kNotClosed);
}

TEST(HullFromPolygons, RefusesIndicesThatDoNotExist) {
  EXPECT_THAT(refusal_of(kCorners, {{0, 2, 7}}), kNotClosed);
  EXPECT_THAT(refusal_of(kCorners, {{0, -1, 2}}), kNotClosed);
  EXPECT_THAT(refusal_of(kCorners, {{0, 1}}), kNotClosed);
  EXPECT_THAT(refusal_of(kCorners, {{0, 0, 1}}), kNotClosed);
}

TEST(HullFromPolygons, RefusesAFaceOf129Vertices) {
  std::vector<int> face(129);
  std::iota(face.begin(), face.end(), 0);
  EXPECT_THAT(refusal_of(prism(129), {face}), HasSubstr("a face has 129 vertices"));
}

/// The plane of the flat hull with these corners.
Plane<double> plane_of(const Points& corners) {
  return hull_from_polygons(corners, {{0, 1, 2, 3}, {3, 2, 1, 0}}).planes[0];
}

TEST(NewellPlane, ARotatedSquareFarAwayHasTheRotatedNormal) {
  Generator random(1);
  const Points square = {Vec3d(-1, 0, 1), Vec3d(1, 0, 1), Vec3d(1, 0, -1), Vec3d(-1, 0, -1)};
  for (int i = 0; i < 20; ++i) {
    const Mat3<double> rotation = random_rotation(random);
    const Vec3d center(1000, -2000, 500);
    const Plane<double> plane = plane_of(transformed(square, rotation, 0.01, center));
    const Vec3d normal = rotation.col(1);
    EXPECT_LT((plane.normal - normal).norm(), 1e-9);
    EXPECT_NEAR(plane.distance(center), 0, 1e-11);
  }
}

TEST(NewellPlane, AWarpedSquareHasThePlaneOfTheMean) {
  const Plane<double> plane =
      plane_of({Vec3d(-1, 0.1, 1), Vec3d(1, -0.1, 1), Vec3d(1, 0.1, -1), Vec3d(-1, -0.1, -1)});
  EXPECT_LT((plane.normal - Vec3d::UnitY()).norm(), 1e-15);
  EXPECT_NEAR(plane.offset, 0, 1e-15);
}

}  // namespace
}  // namespace contactscope::test

#include "geometry/shape.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/hull_builder.h"
#include "geometry/point_sets.h"
#include "geometry/primitives.h"

namespace contactscope {
namespace {

using test::Points;

Shape<double> box_at(const Vec3d& place) {
  Points corners;
  for (const Vec3d& corner : make_box(Vec3d(1, 2, 2)).vertices) corners.push_back(corner + place);
  return build_hull(corners);
}

TEST(FarShape, HasItsCentreMoreThanFourRadiiAway) {
  EXPECT_EQ(moved_origin(box_at({11.9, 0, 0})), Vec3d::Zero());  // its radius is 3
  EXPECT_EQ(moved_origin(box_at({0, -12.1, 0})), Vec3d(0, double(-12.1F), 0));
  EXPECT_EQ(moved_origin(make_box(Vec3d(1, 1, 1))), Vec3d::Zero());
  EXPECT_EQ(moved_origin(Sphere<double>{0.1}), Vec3d::Zero());
  EXPECT_EQ(moved_origin(HalfSpace<double>{{Vec3d::UnitY(), 1e6}}), Vec3d::Zero());
  EXPECT_EQ(moved_origin(Capsule<double>{{Vec3d(100, 0, 0), Vec3d(102, 0, 0)}, 0.5}),
            Vec3d(101, 0, 0));
  EXPECT_EQ(moved_origin(Capsule<double>{{Vec3d(4, 0, 0), Vec3d(6, 0, 0)}, 0.5}), Vec3d::Zero());
}

TEST(FarShape, IsMovedToAPlaceThatAFloatHolds) {
  const Vec3d origin = moved_origin(box_at({1234567.891, -0.1, 54321.987654321}));
  EXPECT_EQ(origin, origin.cast<float>().cast<double>());
  EXPECT_LT((origin - Vec3d(1234567.891, -0.1, 54321.987654321)).norm(), 0.1);
}

TEST(FarShape, AHullKeepsItsShape) {
  test::Generator random(1);
  const Points points = test::in_ball(random, 40);
  const Hull<double> near = build_hull(points);
  const Vec3d away(3e4, -5e4, 1e4);
  Points moved_points = points;
  for (Vec3d& point : moved_points) point += away;
  const Shape<double> far = build_hull(moved_points);
  const Vec3d origin = moved_origin(far);
  const Shape<double> centred = seen_from(far, origin);
  const auto& hull = std::get<Hull<double>>(centred);
  constexpr double kRounding = 1e5 * std::numeric_limits<double>::epsilon();
  const Vec3d rest = away - origin;
  EXPECT_LT(rest.norm(), 1);
  ASSERT_EQ(hull.vertex_count(), near.vertex_count());
  ASSERT_EQ(hull.face_count(), near.face_count());
  for (std::size_t i = 0; i < hull.vertices.size(); ++i)
    EXPECT_LT((hull.vertices[i] - near.vertices[i] - rest).norm(), 2 * kRounding);
  for (std::size_t i = 0; i < hull.planes.size(); ++i) {
    EXPECT_LT((hull.planes[i].normal - near.planes[i].normal).norm(), 1000 * kRounding);
    EXPECT_NEAR(hull.planes[i].distance(hull.centroid), near.planes[i].distance(near.centroid),
                4 * kRounding);
  }
  Hull<double> laid_out = hull;
  lay_out(laid_out);
  EXPECT_EQ(hull.lanes, laid_out.lanes);
}

TEST(FarShape, AMeshKeepsItsTrianglesAndEdges) {
  const Mesh<double> near = make_grid(4, 4, 8, 8, 0.5);
  std::vector<Vec3d> moved_vertices = near.vertices;
  const Vec3d away(0, 4096, -8192);
  for (Vec3d& vertex : moved_vertices) vertex += away;
  const Shape<double> far = build_mesh(moved_vertices, near.triangles);
  const Vec3d origin = moved_origin(far);
  const Shape<double> centred = seen_from(far, origin);
  const auto& mesh = std::get<Mesh<double>>(centred);
  EXPECT_EQ(mesh.triangles, near.triangles);
  EXPECT_EQ(mesh.neighbours, near.neighbours);
  EXPECT_EQ(mesh.edges, near.edges);
  const Vec3d rest = away - origin;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    EXPECT_LT((mesh.vertices[i] - near.vertices[i] - rest).norm(), 4e-12);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    EXPECT_LT((mesh.normals[i] - near.normals[i]).norm(), 1e-10);
  EXPECT_LT((mesh.tree.bounds().center() - near.tree.bounds().center() - rest).norm(), 4e-12);
}

TEST(FarShape, ACapsuleMovesItsEnds) {
  const Capsule<double> pill{{Vec3d(100, 0, 0), Vec3d(102, 0, 0)}, 0.5};
  const Shape<double> centred = seen_from(pill, Vec3d(101, 0, 0));
  const auto& moved = std::get<Capsule<double>>(centred);
  EXPECT_EQ(moved.points[0], Vec3d(-1, 0, 0));
  EXPECT_EQ(moved.points[1], Vec3d(1, 0, 0));
  EXPECT_EQ(moved.radius, 0.5);
}

}  // namespace
}  // namespace contactscope

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/mesh.h"
#include "manifold/placed_shapes.h"
#include "support/brute_force_distance.h"
#include "support/builders.h"
#include "support/cases.h"

/// Triangles without area, which deforming meshes may get, collide as segments and points.
namespace contactscope {
namespace {

using test::at;
using test::deepest_of;
using test::Extended;
using test::ExtendedPoint;
using test::manifolds_of;
using test::Random;

Vec3d integers(Random& random, double reach) {
  return random.vector(-reach, reach).array().round();
}

/// Three points exactly on a line, or one point three times, in any order.
std::array<Vec3d, 3> flat_corners(Random& random, double unit) {
  const Vec3d from = integers(random, 20);
  const Vec3d step = random.chance(0.2) ? Vec3d(Vec3d::Zero()) : integers(random, 6);
  const double between = random.index(3);
  std::array<Vec3d, 3> corners = {from, from + between * step, from + 2 * step};
  std::rotate(corners.begin(), corners.begin() + random.index(3), corners.end());
  for (Vec3d& corner : corners) corner *= unit;
  return corners;
}

Mesh<double> mesh_of(const std::array<Vec3d, 3>& corners) {
  return build_mesh_with_flat_triangles({corners.begin(), corners.end()}, {{0, 1, 2}});
}

test::Features features_of_corners(const std::array<Vec3d, 3>& corners) {
  return test::features_of_triangle(
      {corners[0].cast<Extended>(), corners[1].cast<Extended>(), corners[2].cast<Extended>()});
}

/// Depth of a hull and the hull of some points, along the face normals of the first and
/// perpendicular to the edges of both; negative in overlap.
Extended depth_of(const Hull<double>& hull, const Pose<double>& pose,
                  const test::Features& segment) {
  const test::Features solid = test::features_of(hull, pose);
  Extended best = -std::numeric_limits<Extended>::infinity();
  const auto offer = [&](const ExtendedPoint& direction) {
    if (!(direction.norm() > 1e-12L * hull.radius)) return;
    for (const int sign : {-1, 1}) {
      const ExtendedPoint axis = sign * direction.normalized();
      Extended hull_end = -std::numeric_limits<Extended>::infinity(), segment_end = -hull_end;
      for (const ExtendedPoint& v : solid.vertices) hull_end = std::max(hull_end, axis.dot(v));
      for (const ExtendedPoint& v : segment.vertices)
        segment_end = std::min(segment_end, axis.dot(v));
      best = std::max(best, segment_end - hull_end);
    }
  };
  const auto corner = [&](int i) -> const ExtendedPoint& {
    return contactscope::at(solid.vertices, i);
  };
  for (const auto& [i, j, k] : solid.triangles)
    offer((corner(j) - corner(i)).cross(corner(k) - corner(i)));
  const ExtendedPoint along = segment.vertices[1] - segment.vertices[0],
                      other = segment.vertices[2] - segment.vertices[0];
  for (const auto& [i, j] : solid.edges) {
    const ExtendedPoint edge = corner(j) - corner(i);
    offer(edge.cross(along.norm() > other.norm() ? along : other) / edge.norm());
  }
  return best;
}

template <class S> void shapes_are_as_near_as_the_segment(int cases) {
  Random random(81);
  int touching = 0, deep = 0;
  for (int i = 0; i < cases; ++i) {
    const double unit = std::ldexp(1.0, random.index(20) - 12);
    const std::array<Vec3d, 3> corners = flat_corners(random, unit);
    const test::Features segment = features_of_corners(corners);
    const double size = unit * random.decade(-1, 1.5);
    const double along = random.uniform(0, 1);
    Pose<double> pose = random.pose(0);
    pose.rotation = pose.rotation.cast<S>().normalized().template cast<double>();
    pose.position = test::rounded<S>((1 - along) * corners[0] + along * corners[1] +
                                     random.uniform(0, 1.8) * size * random.unit_vector());
    const int kind = random.index(4);
    Shape<double> shape;
    double distance, radius = 0;
    bool overlaps = false;
    if (kind < 2) {
      radius = test::rounded<S>(size);
      const Vec3d half = kind == 0
                             ? Vec3d(Vec3d::Zero())
                             : test::rounded<S>(size * random.uniform(-1, 1) * Vec3d::UnitY());
      if (kind == 0)
        shape = test::ball(radius);
      else
        shape = Capsule<double>{{-half, half}, radius};
      distance = static_cast<double>(
          test::brute_force_distance(test::features_of_segment(-half, half, pose), segment)
              .distance);
    } else {
      const Hull<double> hull =
          kind == 2 ? test::random_box(random, size, 4) : test::random_hull(random, 12, size, 3);
      shape = hull;
      distance = static_cast<double>(
          test::brute_force_distance(test::features_of(hull, pose), segment).distance);
      overlaps = distance == 0;
      if (overlaps) distance = static_cast<double>(depth_of(hull, pose, segment));
    }
    CollideOptions options;
    options.margin = test::rounded<S>(0.2 * size);
    options.mesh_manifolds = MeshManifolds::Triangle;
    const double separation = distance - radius;
    const double tolerance =
        128 * static_cast<double>(std::numeric_limits<S>::epsilon()) * (40 * unit + 2 * size);
    const Manifolds<S> manifolds = manifolds_of<S>({shape, pose, mesh_of(corners), {}}, options);
    if (std::abs(separation - options.margin) > tolerance) {
      ASSERT_EQ(manifolds.empty(), separation > options.margin) << i << ", kind " << kind;
    }
    if (manifolds.empty()) continue;
    ++touching;
    deep += overlaps;
    ASSERT_NEAR(deepest_of(manifolds), separation, tolerance) << i << ", kind " << kind;
    ASSERT_EQ(manifolds[0].triangle, 0);
    ASSERT_NEAR(test::normal_of(manifolds[0]).norm(), 1,
                64 * static_cast<double>(std::numeric_limits<S>::epsilon()));
  }
  EXPECT_GT(touching, cases / 3);
  EXPECT_GT(deep, cases / 20);
}

TEST(MeshFlatTriangles, SlowShapesAreAsNearAsTheSegmentOrThePoint) {
  shapes_are_as_near_as_the_segment<double>(test::cases(5000));
  shapes_are_as_near_as_the_segment<float>(test::cases(5000));
}

// A strip whose corners have moved onto an edge or each other; some triangles have an area.
template <class S> void ball_is_as_near_as_all_triangles(int cases) {
  Random random(82);
  int touching = 0;
  for (int i = 0; i < cases; ++i) {
    const double unit = std::ldexp(1.0, random.index(20) - 12);
    std::vector<Vec3d> vertices;
    std::vector<std::array<int, 3>> triangles;
    for (int k = 0; k < 8; ++k) {
      vertices.emplace_back(Vec3d(10 * (k % 2), 0, 4 * k) + 2 * integers(random, 2));
      if (k >= 2)
        triangles.push_back(k % 2 == 0 ? std::array{k - 2, k - 1, k} : std::array{k - 1, k - 2, k});
    }
    Mesh<double> mesh = build_mesh_with_flat_triangles(vertices, triangles);
    for (std::size_t k = 2; k < 8; ++k) {
      const int how = random.index(3);
      if (how == 1) mesh.vertices[k] = mesh.vertices[k - 1];
      if (how == 2) mesh.vertices[k] = 0.5 * (mesh.vertices[k - 1] + mesh.vertices[k - 2]);
    }
    for (Vec3d& vertex : mesh.vertices) vertex *= unit;
    refit(mesh);
    const double radius = test::rounded<S>(unit * random.decade(-1, 1));
    const int near = random.index(8), other = random.index(8);
    const double part = random.chance(0.3) ? 0 : random.uniform(0, 1);
    const Vec3d center = test::rounded<S>((1 - part) * contactscope::at(mesh.vertices, near) +
                                          part * contactscope::at(mesh.vertices, other) +
                                          random.uniform(0, 1.1) * radius * random.unit_vector());
    const test::Features point = test::features_of_point(center, {});
    double distance = std::numeric_limits<double>::infinity();
    for (int t = 0; t < mesh.triangle_count(); ++t) {
      const auto nearest = test::brute_force_distance(
          point, features_of_corners({mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)}));
      distance = std::min(distance, static_cast<double>(nearest.distance));
    }
    const double separation = distance - radius;
    const double tolerance =
        64 * static_cast<double>(std::numeric_limits<S>::epsilon()) * 64 * unit;
    const Manifolds<S> manifolds =
        manifolds_of<S>({test::ball(radius), {Quatd::Identity(), center}, mesh, {}});
    if (std::abs(separation) > tolerance) {
      ASSERT_EQ(manifolds.empty(), separation > 0) << i;
    }
    if (manifolds.empty()) continue;
    ++touching;
    ASSERT_NEAR(deepest_of(manifolds), separation, tolerance) << i;
  }
  EXPECT_GT(touching, cases / 3);
}

TEST(MeshFlatTriangles, SlowABallIsAsNearAsTheNearestTriangleWithOrWithoutAnArea) {
  ball_is_as_near_as_all_triangles<double>(test::cases(5000));
  ball_is_as_near_as_all_triangles<float>(test::cases(5000));
}

// The middle one of three triangles closes a T-junction of a flat floor: no edge of the floor.
TEST(MeshFlatTriangles, InAFlatFloorATriangleWithoutAnAreaIsNoEdge) {
  const Mesh<double> floor = build_mesh_with_flat_triangles(
      {{-2, 0, 0}, {2, 0, 0}, {0, 0, 0}, {0, 0, 2}, {-2, 0, -2}, {2, 0, -2}},
      {{{0, 2, 1}}, {{0, 3, 2}}, {{2, 3, 1}}, {{0, 1, 4}}, {{1, 5, 4}}});
  ASSERT_FALSE(has_area(floor, 0));
  for (const double x : {-1.0, -0.3, 0.4, 1.2}) {
    for (const double z : {-0.1, -1e-6, 1e-6, 0.1}) {
      for (const Shape<double>& shape : {test::ball(0.5), Shape<double>(test::cube(0.5))}) {
        const Manifolds<double> manifolds =
            manifolds_of<double>({shape, at(x, 0.49, z), floor, {}});
        ASSERT_FALSE(manifolds.empty());
        for (const Manifold<double>& manifold : manifolds)
          EXPECT_NEAR(manifold.normal.y(), -1, 1e-14) << x << ", " << z;
        EXPECT_NEAR(deepest_of(manifolds), -0.01, 1e-15);
      }
    }
  }
}

// A needle next to a ball does not touch beyond its end.
TEST(MeshFlatTriangles, NothingIsTouchedBeyondTheEndOfANeedle) {
  const Mesh<double> needle = mesh_of({Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0.5, 0, 0)});
  EXPECT_TRUE(manifolds_of<double>({test::ball(0.5), at(1.6, 0, 0), needle, {}}).empty());
  const Manifolds<double> manifolds =
      manifolds_of<double>({test::ball(0.5), at(1.4, 0, 0), needle, {}});
  ASSERT_EQ(manifolds.size(), 1u);
  EXPECT_NEAR(deepest_of(manifolds), -0.1, 1e-15);
  EXPECT_EQ(to_string(manifolds[0].points[0].id), "a:v0 b:v1");
}

}  // namespace
}  // namespace contactscope

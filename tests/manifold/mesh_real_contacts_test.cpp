#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "manifold/placed_shapes.h"
#include "support/brute_force_distance.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/surface_oracle.h"

/// Contacts with real edges and corners are never replaced, unlike those with the tessellation.
namespace contactscope {
namespace {

using test::at;
using test::deepest_of;
using test::manifolds_of;
using test::PlacedShapes;
using test::Random;

struct Surface {
  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> triangles;

  int add(const Vec3d& vertex) {
    vertices.push_back(vertex);
    return count_of(vertices) - 1;
  }
  const Vec3d& corner(int triangle, int k) const {
    return contactscope::at(vertices,
                            contactscope::at(triangles, triangle)[static_cast<std::size_t>(k)]);
  }
};

/// Steps from 0 to 1; some of them are a millionth of others.
std::vector<double> breaks(Random& random, int count) {
  std::vector<double> places = {0};
  for (int i = 0; i < count; ++i) places.push_back(places.back() + random.decade(-6, 0));
  for (double& place : places) place /= places.back();
  return places;
}

/// Triangles between two rails a metre from each other, bent at random. They are as long as that
/// distance and as low as the steps along the rails.
Surface strip(Random& random) {
  Surface surface;
  const std::vector<double> places = breaks(random, 3 + random.index(5));
  const double rough = random.chance(0.5) ? random.decade(-6, -1) : 0;
  for (const double place : places)
    surface.add(Vec3d(count_of(surface.vertices) % 2, 0, place) + rough * random.vector(-1, 1));
  for (int i = 0; i + 2 < count_of(surface.vertices); ++i)
    surface.triangles.push_back(i % 2 == 0 ? std::array{i, i + 1, i + 2}
                                           : std::array{i + 1, i, i + 2});
  return surface;
}

/// A house: four walls in stripes and courses, and a roof around its ridge.
Surface house(Random& random) {
  Surface surface;
  const Vec3d size(1, random.uniform(0.2, 2), random.uniform(0.2, 2));
  const std::vector<double> courses = breaks(random, 1 + random.index(2));
  const Vec3d corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  std::vector<Vec3d> outline;
  for (std::size_t side = 0; side < 4; ++side) {
    const std::vector<double> stripes = breaks(random, 1 + random.index(3));
    for (std::size_t i = 0; i + 1 < stripes.size(); ++i)
      outline.emplace_back(corners[side] + stripes[i] * (corners[(side + 1) % 4] - corners[side]));
  }
  const int around = count_of(outline);
  for (const double height : courses)
    for (const Vec3d& place : outline)
      surface.add((place + height * Vec3d::UnitY()).cwiseProduct(size));
  const int ridge = surface.add(
      Vec3d(0.5, 1 + (random.chance(0.5) ? random.decade(-6, 0) : 0), 0.5).cwiseProduct(size));
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around;
    for (int course = 0; course + 1 < count_of(courses); ++course) {
      const int low = course * around, high = low + around;
      surface.triangles.push_back({low + next, low + i, high + i});
      surface.triangles.push_back({low + next, high + i, high + next});
    }
    const int top = (count_of(courses) - 1) * around;
    surface.triangles.push_back({top + next, top + i, ridge});
  }
  return surface;
}

/// Intersecting pairs of triangles with an edge in common, some of them slivers.
Surface crossing_pairs(Random& random) {
  Surface surface;
  for (int pair = 0; pair < 3; ++pair) {
    const int first = surface.add(random.vector(-1, 1)), second = surface.add(random.vector(-1, 1));
    for (int side = 0; side < 2; ++side) {
      const double along = random.uniform(-0.2, 1.2);
      const int apex = surface.add((1 - along) * surface.vertices[static_cast<std::size_t>(first)] +
                                   along * surface.vertices[static_cast<std::size_t>(second)] +
                                   random.decade(-6, 0) * random.vector(-1, 1));
      surface.triangles.push_back(side == 0 ? std::array{first, second, apex}
                                            : std::array{second, first, apex});
    }
  }
  return surface;
}

/// Any size, away from the origin, with vertices that scalar S represents.
template <class S> Surface random_surface(Random& random, double& size) {
  const int kind = random.index(3);
  Surface surface = kind == 0 ? strip(random) : kind == 1 ? house(random) : crossing_pairs(random);
  size = random.decade(-4, 4);
  const Vec3d place = (random.chance(0.5) ? 5.0 : 0.0) * random.vector(-1, 1);
  for (Vec3d& vertex : surface.vertices) vertex = test::rounded<S>(size * (vertex + place));
  return surface;
}

/// On an edge, at a corner, anywhere, or close to these.
Vec3d place_on(Random& random, const Surface& surface) {
  const int triangle = random.index(count_of(surface.triangles));
  std::array<double, 3> weights;
  for (double& weight : weights) weight = random.chance(0.3) ? 0 : random.decade(-6, 0);
  const double sum = weights[0] + weights[1] + weights[2];
  if (!(sum > 0)) return surface.corner(triangle, 0);
  return (weights[0] * surface.corner(triangle, 0) + weights[1] * surface.corner(triangle, 1) +
          weights[2] * surface.corner(triangle, 2)) /
         sum;
}

double extent_of(const Surface& surface, const Vec3d& other) {
  double most = other.cwiseAbs().maxCoeff();
  for (const Vec3d& vertex : surface.vertices) most = std::max(most, vertex.cwiseAbs().maxCoeff());
  return most;
}

// A ball in a building: the edge of a sliver is nearest, with a less exact normal than a face's.
TEST(MeshRealContacts, TheOpenEdgeOfASliverIsTouched) {
  const std::vector<Vec3d> vertices = {{1, 7, 5},         {1, 8, 5},   {1, 7, 4.8},
                                       {5.3, 7.59, 4.75}, {5, 7.6, 5}, {-0.2, 7.6, 4.746301},
                                       {5, 8, 4}};
  const std::vector<std::array<int, 3>> triangles = {{2, 1, 0}, {5, 4, 3}, {4, 6, 3}};
  const Vec3d center(1, 7.6, 4.7127319509333185);
  const Manifolds<double> manifolds = manifolds_of<double>(
      {test::ball(1), {Quatd::Identity(), center}, build_mesh(vertices, triangles), {}});
  // To the line from (-0.2, 7.6, 4.746301) to (5.3, 7.59, 4.75).
  const Vec3d along = vertices[3] - vertices[5];
  const double distance = along.cross(center - vertices[5]).norm() / along.norm();
  EXPECT_NEAR(distance, 0.0345, 1e-4);
  EXPECT_NEAR(deepest_of(manifolds), distance - 1, 1e-14);
}

template <class S> void ball_is_as_deep_as_the_closest_point(int cases) {
  Random random(71);
  int touching = 0;
  for (int i = 0; i < cases; ++i) {
    double size;
    const Surface surface = random_surface<S>(random, size);
    const double radius = test::rounded<S>(size * random.decade(-3, 0.3));
    const double away = random.chance(0.2) ? random.decade(-6, 0) : random.uniform(0, 1.1);
    const Vec3d center =
        test::rounded<S>(place_on(random, surface) + away * radius * random.unit_vector());
    Mesh<double> mesh;
    MeshReport report;
    mesh = build_mesh(surface.vertices, surface.triangles, &report);
    const test::SurfaceOracle oracle(mesh.vertices, mesh.triangles);
    const double separation = static_cast<double>(oracle.distance(center)) - radius;
    // In the plane, within rounding, either side is right.
    const double tolerance = 128 * static_cast<double>(std::numeric_limits<S>::epsilon()) *
                             (extent_of(surface, center) + radius);
    const Manifolds<S> manifolds =
        manifolds_of<S>({test::ball(radius), {Quatd::Identity(), center}, mesh, {}});
    if (std::abs(separation) > tolerance) {
      ASSERT_EQ(manifolds.empty(), separation > 0) << i;
    }
    if (manifolds.empty()) continue;
    ++touching;
    ASSERT_NEAR(deepest_of(manifolds), separation, tolerance) << i;
  }
  EXPECT_GT(touching, cases / 2);
}

TEST(MeshRealContacts, SlowABallIsAsDeepAsTheClosestPointOfTheWholeMesh) {
  ball_is_as_deep_as_the_closest_point<double>(test::cases(10'000));
  ball_is_as_deep_as_the_closest_point<float>(test::cases(10'000));
}

/// Minimum distance of a segment from all triangles.
double distance_of_segment(const Surface& surface, const Vec3d& from, const Vec3d& to) {
  const test::Features segment = test::features_of_segment(from, to, {});
  double least = std::numeric_limits<double>::infinity();
  for (int t = 0; t < count_of(surface.triangles); ++t) {
    const std::array<test::ExtendedPoint, 3> corners = {
        surface.corner(t, 0).cast<test::Extended>(), surface.corner(t, 1).cast<test::Extended>(),
        surface.corner(t, 2).cast<test::Extended>()};
    const auto nearest = test::brute_force_distance(segment, test::features_of_triangle(corners));
    least = std::min(least, static_cast<double>(nearest.distance));
  }
  return least;
}

template <class S> void capsule_is_as_deep_as_its_closest_points(int cases) {
  Random random(72);
  int touching = 0;
  for (int i = 0; i < cases; ++i) {
    double size;
    const Surface surface = random_surface<S>(random, size);
    const double radius = test::rounded<S>(size * random.decade(-3, 0.3));
    const Vec3d middle =
        place_on(random, surface) + random.uniform(0, 1.1) * radius * random.unit_vector();
    const Vec3d position = test::rounded<S>(middle);
    const Vec3d half = test::rounded<S>(size * random.decade(-3, 0) * random.unit_vector());
    const double distance = distance_of_segment(surface, position - half, position + half);
    const double tolerance = 64 * static_cast<double>(std::numeric_limits<S>::epsilon()) *
                             (extent_of(surface, position) + radius + half.norm());
    if (distance <= tolerance) continue;  // the axis crosses a triangle
    const Mesh<double> mesh = build_mesh(surface.vertices, surface.triangles);
    const Manifolds<S> manifolds = manifolds_of<S>(
        {Capsule<double>{{-half, half}, radius}, {Quatd::Identity(), position}, mesh, {}});
    const double separation = distance - radius;
    if (std::abs(separation) > tolerance) {
      ASSERT_EQ(manifolds.empty(), separation > 0) << i;
    }
    if (manifolds.empty()) continue;
    ++touching;
    ASSERT_NEAR(deepest_of(manifolds), separation, tolerance) << i;
  }
  EXPECT_GT(touching, cases / 3);
}

TEST(MeshRealContacts, SlowACapsuleIsAsDeepAsItsClosestPointsWithTheWholeMesh) {
  capsule_is_as_deep_as_its_closest_points<double>(test::cases(2000));
  capsule_is_as_deep_as_its_closest_points<float>(test::cases(2000));
}

/// Sine of the rise of edge k's other triangle along a direction; -1 without another triangle.
long double rise_across(const Mesh<double>& mesh, int triangle, int k, const Vec3d& direction) {
  const auto corner = [&](int t, int i) -> test::ExtendedPoint {
    return mesh.corner(t, i % 3).cast<test::Extended>();
  };
  const test::ExtendedPoint from = corner(triangle, k), to = corner(triangle, k + 1);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (t == triangle || corner(t, i) != to || corner(t, i + 1) != from) continue;
      const test::ExtendedPoint along = (to - from).normalized();
      const test::ExtendedPoint offset = corner(t, i + 2) - from;
      const test::ExtendedPoint across = offset - offset.dot(along) * along;
      return across.dot(direction.cast<test::Extended>()) / across.norm();
    }
  }
  return -1;
}

// Each triangle alone makes a contact. A contact with an edge must stay if its normal is clearly
// between the normals of the adjacent faces.
template <class S> void hull_keeps_its_contacts_with_edges(int cases) {
  Random random(73);
  int edges = 0;
  for (int i = 0; i < cases; ++i) {
    double size;
    const Surface surface = random_surface<S>(random, size);
    const Mesh<double> mesh = build_mesh(surface.vertices, surface.triangles);
    const Hull<double> hull = random.chance(0.5) ? test::random_box(random, size, 10)
                                                 : test::random_hull(random, 10, size, 3);
    Pose<double> pose = random.pose(0);
    pose.position = place_on(random, surface) + 0.9 * size * random.vector(-1, 1);
    const PlacedShapes pair{hull, pose, mesh, {}};
    CollideOptions care, by_itself;
    care.mesh_manifolds = by_itself.mesh_manifolds = MeshManifolds::Triangle;
    by_itself.internal_edges = false;
    const Manifolds<S> all = manifolds_of<S>(pair, by_itself), kept = manifolds_of<S>(pair, care);
    for (const Manifold<S>& manifold : all) {
      if (manifold.axis != AxisKind::EdgeEdge) continue;
      const Vec3d normal = -test::normal_of(manifold);
      const int edge = static_cast<int>(manifold.points[0].id.second.index);
      const bool is_back = normal.dot(mesh.normal(manifold.triangle)) < -0.9;
      if (is_back || rise_across(mesh, manifold.triangle, edge, normal) > -1e-3) continue;
      ++edges;
      ASSERT_TRUE(std::ranges::any_of(kept, [&](const Manifold<S>& other) {
        return other.triangle == manifold.triangle && other.normal == manifold.normal &&
               deepest_of(other) == deepest_of(manifold);
      })) << i;
    }
  }
  EXPECT_GT(edges, cases / 10);
}

TEST(MeshRealContacts, SlowAHullKeepsItsContactsWithTheEdgesOfTheSurface) {
  hull_keeps_its_contacts_with_edges<double>(test::cases(5000));
  hull_keeps_its_contacts_with_edges<float>(test::cases(5000));
}

}  // namespace
}  // namespace contactscope

#include "bench/draw_mesh.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "geometry/primitives.h"

namespace contactscope::bench {
namespace {

using test::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Interval {
  double low = -kInfinity;
  double high = kInfinity;
};

/// The part of the vertical line through `place` that is inside all planes.
Interval inside(const std::vector<Plane<double>>& planes, const Vec3d& place) {
  Interval result;
  for (const Plane<double>& plane : planes) {
    const double rest = plane.offset - plane.normal.x() * place.x() - plane.normal.z() * place.z();
    const double slope = plane.normal.y();
    if (slope > 0) result.high = std::min(result.high, rest / slope);
    if (slope < 0) result.low = std::max(result.low, rest / slope);
    if (slope == 0 && rest < 0) return {kInfinity, -kInfinity};
  }
  return result;
}

std::vector<Plane<double>> placed_planes(const Hull<double>& hull, const Pose<double>& pose) {
  std::vector<Plane<double>> result;
  for (const Plane<double>& plane : hull.planes) {
    const Vec3d normal = pose.rotate(plane.normal);
    result.push_back({normal, plane.offset + normal.dot(pose.position)});
  }
  return result;
}

/// Height of a triangle above or below `place`; -infinity if `place` is not above or below it.
double height_at(const Mesh<double>& mesh, int triangle, const Vec3d& place) {
  for (int k = 0; k < 3; ++k) {
    const Vec3d edge = mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k);
    const Vec3d to = place - mesh.corner(triangle, k);
    if (edge.z() * to.x() - edge.x() * to.z() < 0) return -kInfinity;
  }
  const Vec3d& normal = mesh.normal(triangle);
  const Vec3d from = mesh.corner(triangle, 0) - place;
  return place.y() + normal.dot(from) / normal.y();
}

/// Vertical clearance between hull and grid, measured at the vertices of both.
double clearance(const Hull<double>& hull, const Pose<double>& pose, const Mesh<double>& grid) {
  const std::vector<Plane<double>> planes = placed_planes(hull, pose);
  double least = kInfinity;
  for (int t = 0; t < grid.triangle_count(); ++t) {
    if ((grid.corner(t, 0) - pose.position).norm() > 3) continue;
    for (int k = 0; k < 3; ++k) {
      const Interval solid = inside(planes, grid.corner(t, k));
      if (solid.low <= solid.high) least = std::min(least, solid.low - grid.corner(t, k).y());
    }
    for (const Vec3d& vertex : hull.vertices) {
      const Vec3d place = pose.transform(vertex);
      least = std::min(least, place.y() - height_at(grid, t, place));
    }
  }
  return least;
}

/// Roughly along the surface, like a body at rest.
Quatd level(const Mesh<double>& grid, int triangle, Random& random) {
  const Quatd yaw(Eigen::AngleAxisd(random.uniform(0, 2 * std::numbers::pi), Vec3d::UnitY()));
  return Quatd(Quatd::FromTwoVectors(Vec3d::UnitY(), grid.normal(triangle)) * yaw);
}

}  // namespace

Mesh<double> wavy_grid() { return make_grid(50, 25, 100, 50, 0.5); }

DrawnHull draw_on_mesh(Workload workload, const Mesh<double>& grid, Random& random) {
  // Avoid the rim.
  int triangle = 0;
  Vec3d place;
  do {
    triangle = random.index(grid.triangle_count());
    place = grid.corner(triangle, 0) + random.level(0.25, 0);
  } while (std::abs(place.x()) > 23 || std::abs(place.z()) > 10.5);

  DrawnHull drawn;
  if (workload == Workload::BoxMesh) {
    drawn.hull = make_box(Vec3d(0.5, 0.5, 0.5));
    drawn.pose.rotation = level(grid, triangle, random);
  } else {
    drawn.hull = test::random_hull(random, 16, 0.5, 1);
    drawn.pose.rotation = random.rotation();
  }
  drawn.pose.position = place + Vec3d(0, 1, 0);
  const double gap = clearance(drawn.hull, drawn.pose, grid);
  drawn.pose.position.y() -= gap + random.uniform(0.001, 0.010);
  return drawn;
}

}  // namespace contactscope::bench

#include "peers/mesh_pair.h"

#include <algorithm>
#include <utility>

#include "support/brute_force_sat.h"
#include "support/random_geometry.h"

namespace contactscope::peers {
namespace {

using test::Random;

/// A triangle as a flat hull with a face on each side.
Hull<double> flat_hull(const Mesh<double>& mesh, int triangle) {
  Hull<double> result;
  for (int k = 0; k < 3; ++k) {
    result.vertices.push_back(mesh.corner(triangle, k));
    // Forwards around the front, and backwards around the back.
    result.half_edges.push_back({k, 2 * ((k + 1) % 3), 0});
    result.half_edges.push_back({(k + 1) % 3, 2 * ((k + 2) % 3) + 1, 1});
    result.centroid += mesh.corner(triangle, k) / 3;
  }
  for (const Vec3d& vertex : result.vertices) {
    result.radius = std::max(result.radius, (vertex - result.centroid).norm());
  }
  const Vec3d& normal = mesh.normal(triangle);
  const double offset = normal.dot(mesh.corner(triangle, 0));
  result.planes = {{normal, offset}, {-normal, -offset}};
  result.face_edges = {0, 1};
  return result;
}

/// A random place in a triangle that is not at the rim; sometimes on one of its edges.
Vec3d random_place(const Mesh<double>& mesh, int triangle, Random& random) {
  double weights[3] = {random.uniform(0.05, 1), random.uniform(0.05, 1), random.uniform(0.05, 1)};
  if (random.chance(0.3)) weights[random.index(3)] = 0;
  Vec3d place = Vec3d::Zero();
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    place += weights[k] * mesh.corner(triangle, k);
    sum += weights[k];
  }
  return place / sum;
}

double reach_of(const Shape<double>& shape) {
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) return hull->radius;
  const auto* capsule = std::get_if<Capsule<double>>(&shape);
  return radius_of(shape) + (capsule == nullptr ? 0 : capsule->points[1].norm());
}

}  // namespace

std::vector<OnMesh> hulls_on_mesh(bench::Workload workload, int count) {
  Random random(20150308);
  std::vector<OnMesh> result;
  for (const bench::WorkloadPair& pair : bench::make_workload(workload, count)) {
    const bench::Placement& placed = pair.steps.front();
    OnMesh on{pair.a, pair.b, placed.a, placed.b};
    const Vec3d up = on.mesh_pose.rotate(Vec3d::UnitY());
    if (result.size() % 2 == 1) on.pose.position += random.uniform(0.005, 0.020) * up;
    result.push_back(std::move(on));
  }
  return result;
}

std::vector<OnMesh> rounds_on_mesh(ShapeKind kind, int count) {
  constexpr double kRadius = 0.25, kHalfHeight = 0.25;
  const auto grid = bench::make_workload(bench::Workload::BoxMesh, 1).front().b;
  const auto& mesh = std::get<Mesh<double>>(*grid);
  const Vec3d end(0, kHalfHeight, 0);
  const auto shape = std::make_shared<const Shape<double>>(
      kind == ShapeKind::Sphere ? Shape<double>(Sphere<double>{kRadius})
                                : Shape<double>(Capsule<double>{{-end, end}, kRadius}));
  Random random(20150309);
  std::vector<OnMesh> result;
  while (result.size() < static_cast<std::size_t>(count)) {
    const int triangle = random.index(mesh.triangle_count());
    const Vec3d place = random_place(mesh, triangle, random);
    if (std::abs(place.x()) > 23 || std::abs(place.z()) > 10.5) continue;
    const Quatd turn = random.rotation();
    const Vec3d& up = mesh.normal(triangle);
    const double low = kind == ShapeKind::Sphere ? 0 : std::abs(up.dot(turn * end));
    const double wanted = (result.size() % 2 == 1 ? 1 : -1) * random.uniform(0.001, 0.010);
    const Pose<double> on{turn, place + (kRadius + low + wanted) * up};
    const Pose<double> whole = random.pose(5);
    Pose<double> placed = compose(whole, on);
    placed.rotation.normalize();
    result.push_back({shape, grid, placed, whole});
  }
  return result;
}

std::vector<WithTriangle> triangles_near(const OnMesh& pair) {
  const Mesh<double>& mesh = pair.the_mesh();
  const auto* hull = std::get_if<Hull<double>>(pair.shape.get());
  const Vec3d middle = hull == nullptr ? Vec3d::Zero() : hull->centroid;
  const Vec3d centre = pair.mesh_pose.inverse_transform(pair.pose.transform(middle));
  std::vector<WithTriangle> result;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    constexpr double kCell = 0.8;  // the longest edge of a triangle
    if ((mesh.corner(t, 0) - centre).norm() > reach_of(*pair.shape) + kCell) continue;
    if (hull != nullptr) {
      const test::PairCase<double> hulls{*hull, pair.pose, flat_hull(mesh, t), pair.mesh_pose};
      const test::BruteForceAxis axis =
          test::brute_force_sat(hulls.a, hulls.pose_a, hulls.b, hulls.pose_b);
      result.push_back({hulls, axis.separation, axis.normal});
    } else {
      const RoundPair round{*pair.shape, pair.pose, flat_hull(mesh, t), pair.mesh_pose};
      result.push_back({round, separation_by_exhaustion(round), {}});
    }
  }
  std::ranges::sort(result, {}, &WithTriangle::separation);
  constexpr double kNear = 0.05;
  const auto far = std::ranges::find_if(
      result, [](const WithTriangle& triangle) { return triangle.separation > kNear; });
  result.erase(std::max(far, result.begin() + 1), result.end());
  return result;
}

}  // namespace contactscope::peers

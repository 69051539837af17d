#include "study/overlapping_hulls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/hull_builder.h"
#include "study/uniform.h"

namespace contactscope {
namespace {

Vec3d unit_vector(std::mt19937_64& engine) {
  const double z = uniform(engine, -1, 1);
  const double turn = uniform(engine, 0, 2 * std::numbers::pi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

Hull<double> ellipsoid_hull(std::mt19937_64& engine, int vertices, double size) {
  const Quatd turn = uniform_rotation(engine);
  Vec3d axes;
  for (int i = 0; i < 3; ++i) axes[i] = size * uniform(engine, 0.5, 1);
  std::vector<Vec3d> points;
  for (int i = 0; i < vertices; ++i) {
    const Vec3d on_sphere = unit_vector(engine);
    points.push_back(turn * Vec3d(axes.cwiseProduct(on_sphere)));
  }
  return build_hull(points);
}

}  // namespace

OverlappingHulls overlapping_hulls(std::mt19937_64& engine, int vertices) {
  for (;;) {
    OverlappingHulls hulls;
    hulls.size = std::pow(10.0, uniform(engine, -3, 3));
    hulls.a = ellipsoid_hull(engine, vertices, hulls.size);
    hulls.b = ellipsoid_hull(engine, vertices, hulls.size);
    hulls.b_in_a.rotation = uniform_rotation(engine);
    hulls.way = unit_vector(engine);
    hulls.turn_axis = unit_vector(engine);
    const Vec3d direction = unit_vector(engine);
    const double overlap = hulls.size * uniform(engine, 0.01, 0.1);
    double reach_a = 0, reach_b = 0;
    for (const Vec3d& v : hulls.a.vertices) reach_a = std::max(reach_a, direction.dot(v));
    for (const Vec3d& v : hulls.b.vertices) {
      reach_b = std::max(reach_b, -direction.dot(hulls.b_in_a.rotate(v)));
    }
    hulls.b_in_a.position = (reach_a + reach_b - overlap) * direction;
    hulls.deepest = oracle_axis(hulls.a, hulls.b, hulls.b_in_a);
    // A kiss is no overlap: what float makes of it is chance.
    if (hulls.deepest.separation < -1e-3 * hulls.size) return hulls;
  }
}

}  // namespace contactscope

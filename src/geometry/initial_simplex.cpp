#include <cmath>
#include <tuple>
#include <utility>

#include "core/at.h"
#include "geometry/quickhull.h"

namespace contactscope::quickhull {
namespace {

/// Index and value of the point with the largest value; the first among equals.
template <class Value>
std::pair<int, double> farthest(std::span<const Vec3d> points, const Value& value) {
  std::pair<int, double> best{0, value(points[0])};
  for (int i = 1; i < count_of(points); ++i) {
    const double candidate = value(at(points, i));
    if (candidate > best.second) best = {i, candidate};
  }
  return best;
}

}  // namespace

Simplex initial_simplex(std::span<const Vec3d> points, double tolerance) {
  Simplex simplex;
  auto& [a, b, c, d] = simplex.points;

  std::vector<int> extremes;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const auto along_axis = [&](const Vec3d& point) { return sign * point[axis]; };
      extremes.push_back(farthest(points, along_axis).first);
    }
  }
  double longest = -1;
  for (const int one : extremes) {
    for (const int other : extremes) {
      const double length = (at(points, other) - at(points, one)).norm();
      if (length <= longest) continue;
      longest = length;
      a = one;
      b = other;
    }
  }
  if (longest <= tolerance) return {Status::Coincident, simplex.points, 0};

  const Vec3d& origin = at(points, a);
  const Vec3d along = (at(points, b) - origin) / longest;
  double distance = 0;
  std::tie(c, distance) = farthest(points, [&](const Vec3d& point) {
    const Vec3d arm = point - origin;
    return along.cross(arm).norm();
  });
  if (distance <= tolerance) return {Status::Collinear, simplex.points, 0};

  const Vec3d third = at(points, c) - origin;
  const Vec3d normal = along.cross(third).normalized();
  const auto height = [&](const Vec3d& point) -> double { return normal.dot(point - origin); };
  std::tie(d, simplex.thickness) =
      farthest(points, [&](const Vec3d& point) { return std::abs(height(point)); });
  if (simplex.thickness <= tolerance)
    simplex.status = Status::Coplanar;
  else if (height(at(points, d)) > 0)
    std::swap(a, b);  // the fourth goes below the three
  return simplex;
}

}  // namespace contactscope::quickhull

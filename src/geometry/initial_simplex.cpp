#include "geometry/initial_simplex.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace contactscope::quickhull {
namespace {

/// Index and value of the point with the largest value; the first among equals.
template <class Value>
std::pair<int, double> farthest(std::size_t count, const Value& value) {
  std::pair<int, double> best{0, value(0)};
  for (std::size_t i = 1; i < count; ++i) {
    const double candidate = value(i);
    if (candidate > best.second) best = {static_cast<int>(i), candidate};
  }
  return best;
}

}  // namespace

Simplex initial_simplex(std::span<const Vec3d> points, double tolerance) {
  const auto at = [&](int i) -> const Vec3d& { return points[static_cast<std::size_t>(i)]; };
  Simplex simplex;
  int& a = simplex.points[0];
  int& b = simplex.points[1];
  int& c = simplex.points[2];
  int& d = simplex.points[3];

  std::vector<int> extremes;
  for (int axis = 0; axis < 3; ++axis) {
    extremes.push_back(
        farthest(points.size(), [&](std::size_t i) { return points[i][axis]; }).first);
    extremes.push_back(
        farthest(points.size(), [&](std::size_t i) { return -points[i][axis]; }).first);
  }
  double longest = -1;
  for (const int one : extremes) {
    for (const int other : extremes) {
      const Vec3d span = at(other) - at(one);
      if (span.norm() > longest) {
        longest = span.norm();
        a = one;
        b = other;
      }
    }
  }
  if (longest <= tolerance) {
    simplex.status = Status::Coincident;
    return simplex;
  }

  const Vec3d along = (at(b) - at(a)) / longest;
  const auto from_line = farthest(points.size(), [&](std::size_t i) {
    const Vec3d arm = points[i] - at(a);
    return along.cross(arm).norm();
  });
  c = from_line.first;
  if (from_line.second <= tolerance) {
    simplex.status = Status::Collinear;
    return simplex;
  }

  const Vec3d third = at(c) - at(a);
  const Vec3d normal = along.cross(third).normalized();
  const auto height = [&](std::size_t i) -> double {
    const Vec3d arm = points[i] - at(a);
    return normal.dot(arm);
  };
  const auto from_plane =
      farthest(points.size(), [&](std::size_t i) { return std::abs(height(i)); });
  d = from_plane.first;
  simplex.thickness = from_plane.second;
  if (from_plane.second <= tolerance) {
    simplex.status = Status::Coplanar;
    return simplex;
  }
  if (height(static_cast<std::size_t>(d)) > 0) std::swap(a, b);  // the fourth goes below the three
  return simplex;
}

}  // namespace contactscope::quickhull

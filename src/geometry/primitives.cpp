#include "geometry/primitives.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/manifold.h"
#include "geometry/hull_from_polygons.h"

namespace contactscope {
namespace {

void require_length(const std::string& name, double value) {
  if (std::isfinite(value) && value > 0) return;
  std::ostringstream message;
  message << name << " is " << value << "; it must be a finite length above 0";
  throw ShapeError(message.str());
}

void require_segments(int segments) {
  if (segments >= 3 && segments <= static_cast<int>(kMaxFaceVertices)) return;
  throw ShapeError("segments is " + std::to_string(segments) + "; it must be between 3 and " +
                   std::to_string(kMaxFaceVertices));
}

/// Corner `k` of the regular polygon on the circle of `radius` in the x-z plane, counter-clockwise
/// seen from +y. The angle is reduced to an eighth of a turn in integers first, so that corners
/// that mirror each other do so to the last bit and those on an axis lie on it.
Vec3d corner(int k, int segments, double radius) {
  const int quadrant = 4 * k / segments;
  const int rest = 4 * k % segments;  // angle in the quadrant is rest / segments quarter turns
  const bool upper = 2 * rest > segments;
  const int folded = upper ? segments - rest : rest;
  const double angle = 0.5 * std::numbers::pi * folded / segments;
  const bool diagonal = 2 * rest == segments;
  double along = diagonal ? std::numbers::sqrt2 / 2 : std::cos(angle);
  double across = diagonal ? std::numbers::sqrt2 / 2 : std::sin(angle);
  if (upper) std::swap(along, across);
  for (int i = 0; i < quadrant; ++i) along = -std::exchange(across, along);
  return radius * Vec3d(along, 0, -across);
}

/// A hull whose centroid and radius are known exactly, and not left to rounding.
Hull<double> centred(Hull<double> hull, const Vec3d& centroid, double radius) {
  hull.centroid = centroid;
  hull.radius = radius;
  lay_out(hull);
  return hull;
}

}  // namespace

Hull<double> make_box(const Vec3d& half_extents) {
  for (int axis = 0; axis < 3; ++axis)
    require_length("the box's half extent along " + std::string(1, "xyz"[axis]),
                   half_extents[axis]);
  std::vector<Vec3d> vertices;
  for (int i = 0; i < 8; ++i) {
    const Vec3d signs((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    vertices.emplace_back(signs.cwiseProduct(half_extents));
  }
  Hull<double> hull = hull_from_polygons(
      std::move(vertices),
      {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3}, {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}});
  // What is known exactly is not left to rounding.
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t face = 2 * static_cast<std::size_t>(axis);
    const Vec3d unit = Vec3d::Unit(axis);
    hull.planes[face] = {unit, half_extents[axis]};
    hull.planes[face + 1] = {-unit, half_extents[axis]};
  }
  return centred(std::move(hull), Vec3d::Zero(), half_extents.stableNorm());
}

Hull<double> make_cylinder(double radius, double half_height, int segments) {
  require_length("the cylinder's radius", radius);
  require_length("the cylinder's half_height", half_height);
  require_segments(segments);
  std::vector<Vec3d> vertices;
  std::vector<std::vector<int>> faces(2);
  for (int k = 0; k < segments; ++k) {
    const Vec3d rim = corner(k, segments, radius);
    vertices.emplace_back(rim.x(), -half_height, rim.z());
    vertices.emplace_back(rim.x(), half_height, rim.z());
    faces[0].push_back(2 * k + 1);
    faces[1].push_back(2 * (segments - 1 - k));
  }
  for (int k = 0; k < segments; ++k) {
    const int next = (k + 1) % segments;
    faces.push_back({2 * k, 2 * next, 2 * next + 1, 2 * k + 1});
  }
  Hull<double> hull = hull_from_polygons(std::move(vertices), faces);
  hull.planes[0] = {Vec3d::UnitY(), half_height};
  hull.planes[1] = {-Vec3d::UnitY(), half_height};
  return centred(std::move(hull), Vec3d::Zero(), Vec3d(radius, half_height, 0).stableNorm());
}

Hull<double> make_cone(double radius, double half_height, int segments) {
  require_length("the cone's radius", radius);
  require_length("the cone's half_height", half_height);
  require_segments(segments);
  std::vector<Vec3d> vertices;
  std::vector<std::vector<int>> faces(1);
  for (int k = 0; k < segments; ++k) {
    const Vec3d rim = corner(k, segments, radius);
    vertices.emplace_back(rim.x(), -half_height, rim.z());
    faces[0].push_back(segments - 1 - k);
  }
  vertices.emplace_back(0, half_height, 0);
  for (int k = 0; k < segments; ++k) faces.push_back({k, (k + 1) % segments, segments});
  Hull<double> hull = hull_from_polygons(std::move(vertices), faces);
  hull.planes[0] = {-Vec3d::UnitY(), half_height};
  // A pyramid's centre of mass lies a quarter of its height above the base; an odd polygon's mean
  // is on the axis in exact arithmetic only.
  const double to_rim = Vec3d(radius, 0.5 * half_height, 0).stableNorm();
  return centred(std::move(hull), Vec3d(0, -0.5 * half_height, 0),
                 std::max(to_rim, 1.5 * half_height));
}

}  // namespace contactscope

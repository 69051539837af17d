#include "geometry/primitives.h"

#include "geometry/box_topology.h"
#include "geometry/hull_builder.h"

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
/// seen from +y. The angle is first reduced to an eighth of a turn in integers, so that mirrored
/// corners agree to the last bit and corners on an axis lie exactly on it.
Vec3d corner(int k, int segments, double radius) {
  const int quadrant = 4 * k / segments;
  const int rest = 4 * k % segments;  // the angle in the quadrant is rest / segments quarter turns
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

void require_cells(int cells_x, int cells_z) {
  // Divide, because a product of two ints may overflow.
  if (cells_x > 0 && cells_z > 0 && cells_x <= kMaxGridCells / cells_z) return;
  throw ShapeError("the grid has " + std::to_string(cells_x) + " by " + std::to_string(cells_z) +
                   " cells; give at least 1 along each side and at most " +
                   std::to_string(kMaxGridCells) + " together");
}

/// Line i of `cells` + 1 as a fraction of the side: -1/2 to 1/2, symmetric, exact at both ends.
double part(int i, int cells) { return (2.0 * i - cells) / (2.0 * cells); }

/// Sets the exactly known centroid and radius of a hull, instead of the rounded ones.
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
  std::vector<std::vector<int>> faces;
  for (const auto& face : kBoxFaces) faces.emplace_back(std::begin(face), std::end(face));
  Hull<double> hull = hull_from_polygons(std::move(vertices), faces);
  // Set the exactly known planes, instead of the rounded ones.
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
  // A pyramid's centre of mass lies a quarter of its height above the base. For an odd polygon the
  // computed mean would be off the axis by rounding.
  const double to_rim = Vec3d(radius, 0.5 * half_height, 0).stableNorm();
  return centred(std::move(hull), Vec3d(0, -0.5 * half_height, 0),
                 std::max(to_rim, 1.5 * half_height));
}

Mesh<double> make_grid(double size_x, double size_z, int cells_x, int cells_z, double amplitude) {
  require_length("size_x", size_x);
  require_length("size_z", size_z);
  require_cells(cells_x, cells_z);
  if (!std::isfinite(amplitude))
    throw ShapeError("the amplitude is not a finite number; give a length in metres");
  constexpr double kWaves = 3;  // along each side
  constexpr double kTurn = 2 * std::numbers::pi * kWaves;
  std::vector<Vec3d> vertices;
  for (int j = 0; j <= cells_z; ++j) {
    const double z = part(j, cells_z);
    for (int i = 0; i <= cells_x; ++i) {
      const double x = part(i, cells_x);
      const double y = amplitude * std::sin(kTurn * x) * std::cos(kTurn * z);
      vertices.emplace_back(size_x * x, y, size_z * z);
    }
  }
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j < cells_z; ++j) {
    for (int i = 0; i < cells_x; ++i) {
      const int corner = i + (cells_x + 1) * j;
      const int across = corner + cells_x + 2;
      triangles.push_back({corner, across - 1, corner + 1});
      triangles.push_back({across, corner + 1, across - 1});
    }
  }
  return build_mesh(std::move(vertices), std::move(triangles));
}

}  // namespace contactscope

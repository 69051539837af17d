#pragma once

#include "draw/scene/sketch.h"

/// Convex polygons on the screen and their visible parts.
namespace contactscope::draw {

using Outline = std::vector<Vec2d>;  // convex, pixels, in the winding of convex_polygon()

Outline as_outline(const std::vector<Point2>& polygon);

/// Convex outline of points in the world; empty if fewer than three are in front of the camera.
Outline outline_around(const Camera& camera, std::span<const Vec3d> points);

/// Whether a convex polygon and a box share a point.
bool overlap(const Outline& polygon, const Eigen::AlignedBox2d& box);

/// Whether a box is inside a convex polygon.
bool lies_on(const Outline& polygon, const Eigen::AlignedBox2d& box);

/// The parts of the polygons outside of a convex one, in pieces of at least a hundredth of
/// a square pixel.
std::vector<Outline> without(const std::vector<Outline>& polygons, const Outline& hole);

/// Adds to each polygon the corners of the others that are on its edges. Otherwise a rasterizer, which
/// rounds corners, would leave out pixels between two polygons that share a border, or fill them twice.
std::vector<Outline> with_shared_corners(std::vector<Outline> pieces);

/// Bodies among the surfaces that are in front of a polygon on the screen. Each flat face is a
/// polygon, each round body one outline. Empty if there are too many faces, as on a landscape.
std::vector<Outline> outlines_before(const std::vector<Point2>& polygon, const Camera& camera,
                                     std::span<const Surface> surfaces);

inline Eigen::AlignedBox3d solid_box(const trace::Box& box) { return {box.lower, box.upper}; }

/// Faces of a box: along each axis the lower one, then the upper one.
inline std::vector<std::vector<Vec3d>> sides_of(const Eigen::AlignedBox3d& box) {
  std::vector<std::vector<Vec3d>> sides;
  for (int axis = 0; axis < 3; ++axis) {
    for (const Vec3d* end : {&box.min(), &box.max()}) {
      std::vector<Vec3d>& side = sides.emplace_back(4, box.min());
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      side[1][u] = side[2][u] = box.max()[u];
      side[2][v] = side[3][v] = box.max()[v];
      for (Vec3d& corner : side) corner[axis] = (*end)[axis];
    }
  }
  return sides;
}

/// The twelve edges; a flat box draws each edge once.
inline void outline(const trace::Box& box, const Pose<double>& pose, const LineStyle& style,
                    Sketch& sketch) {
  int flat = 0;  // bits of the axes along which the box has no extent
  for (int k = 0; k < 3; ++k) flat |= box.lower[k] == box.upper[k] ? 1 << k : 0;
  // By bits: 1 the upper x, 2 the upper y, 4 the upper z.
  const auto corner = [&](int bits) {
    return pose.transform(
        solid_box(box).corner(static_cast<Eigen::AlignedBox3d::CornerType>(bits)));
  };
  for (int bits = 0; bits < 8; ++bits) {
    for (const int axis : {1, 2, 4}) {
      if ((bits & axis) != 0 || ((bits | axis) & flat) != 0) continue;
      sketch.line(corner(bits), corner(bits | axis), style);
    }
  }
}

/// Contour line of a value on a grid. Points are in grid steps: column, row, 0.
struct Contour {
  std::vector<Vec3d> points;
  bool closed = false;
};

/// Contour lines at `level`: marching squares (after Lorensen and Cline 1987, in the plane), linear
/// between neighbours, chained from square to square. In an ambiguous square the mean of its
/// corners decides. `values`: row by row, `columns` each; fewer than two rows or columns give no
/// lines.
std::vector<Contour> contours_at(std::span<const double> values, int columns, double level);

}  // namespace contactscope::draw

#pragma once

#include "core/pose.h"
#include "draw/scene/sketch.h"
#include "trace/pair.h"

namespace contactscope::draw {

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

}  // namespace contactscope::draw

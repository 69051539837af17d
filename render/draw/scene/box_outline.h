#pragma once

#include "core/pose.h"
#include "draw/scene/sketch.h"
#include "trace/pair.h"

namespace contactscope::draw {

/// The twelve edges; a flat box draws each edge once.
inline void outline(const trace::Box& box, const Pose<double>& pose, const LineStyle& style,
                    Sketch& sketch) {
  int flat = 0;  // bits of the axes along which the box has no extent
  for (int k = 0; k < 3; ++k) flat |= box.lower[k] == box.upper[k] ? 1 << k : 0;
  // By bits: 1 the upper x, 2 the upper y, 4 the upper z.
  const auto corner = [&](int bits) {
    const Eigen::AlignedBox3d solid(box.lower, box.upper);
    return pose.transform(solid.corner(static_cast<Eigen::AlignedBox3d::CornerType>(bits)));
  };
  for (int bits = 0; bits < 8; ++bits) {
    for (const int axis : {1, 2, 4}) {
      if ((bits & axis) != 0 || ((bits | axis) & flat) != 0) continue;
      sketch.line(corner(bits), corner(bits | axis), style);
    }
  }
}

}  // namespace contactscope::draw

#pragma once

#include "core/pose.h"
#include "draw/scene/sketch.h"
#include "trace/pair.h"

namespace contactscope::draw {

/// The corner of a box by bits: 1 the upper x, 2 the upper y, 4 the upper z.
inline Vec3d corner(const trace::Box& box, int bits) {
  return {(bits & 1) != 0 ? box.upper.x() : box.lower.x(),
          (bits & 2) != 0 ? box.upper.y() : box.lower.y(),
          (bits & 4) != 0 ? box.upper.z() : box.lower.z()};
}

/// The twelve edges; of a flat box each but once.
inline void outline(const trace::Box& box, const Pose<double>& pose, const LineStyle& style,
                    Sketch& sketch) {
  int flat = 0;  // bits of the axes along which the box has no extent
  for (int k = 0; k < 3; ++k) flat |= box.lower[k] == box.upper[k] ? 1 << k : 0;
  for (int bits = 0; bits < 8; ++bits) {
    for (const int axis : {1, 2, 4}) {
      if ((bits & axis) != 0 || ((bits | axis) & flat) != 0) continue;
      sketch.line(pose.transform(corner(box, bits)), pose.transform(corner(box, bits | axis)),
                  style);
    }
  }
}

}  // namespace contactscope::draw

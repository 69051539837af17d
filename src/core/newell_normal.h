#pragma once

#include <span>

#include "core/vec3.h"

namespace contactscope {

/// Newell's normal of any flat polygon, also with collinear vertices. Its length is twice the area.
inline Vec3d newell_normal(std::span<const Vec3d> polygon) {
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d& next = polygon[(i + 1) % polygon.size()];
    normal += (polygon[i] - polygon[0]).cross(next - polygon[0]);
  }
  return normal;
}

}  // namespace contactscope

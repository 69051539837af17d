#pragma once

#include <span>
#include <vector>

#include "core/vec3.h"

/// What follows from many points at once.
namespace contactscope::draw {

/// The box around points, metres; empty without any.
inline Eigen::AlignedBox3d box_around(std::span<const Vec3d> points) {
  Eigen::AlignedBox3d box;
  for (const Vec3d& p : points) box.extend(p);
  return box;
}

/// The middle of that box; at least one point.
inline Vec3d center_of(std::span<const Vec3d> points) {
  return box_around(points).center();
}

/// Their mean; at least one.
inline Vec3d mean_of(std::span<const Vec3d> points) {
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Newell's normal, right for any flat polygon, also with collinear vertices. As long as twice the
/// polygon's area.
inline Vec3d newell_normal(std::span<const Vec3d> polygon) {
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d& next = polygon[(i + 1) % polygon.size()];
    normal += (polygon[i] - polygon[0]).cross(next - polygon[0]);
  }
  return normal;
}

inline void append(std::vector<Vec3d>& points, std::span<const Vec3d> more) {
  points.insert(points.end(), more.begin(), more.end());
}

}  // namespace contactscope::draw

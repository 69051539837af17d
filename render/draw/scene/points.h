#pragma once

#include "core/convex_polygon.h"
#include "core/pose.h"

/// Properties of point sets and polygons.
namespace contactscope::draw {

/// Bounding box of points, metres; empty without points.
inline Eigen::AlignedBox3d box_around(std::span<const Vec3d> points) {
  Eigen::AlignedBox3d box;
  for (const Vec3d& p : points) box.extend(p);
  return box;
}

/// Centre of the bounding box; needs at least one point.
inline Vec3d center_of(std::span<const Vec3d> points) { return box_around(points).center(); }

/// Mean of the points; at least one.
inline Vec3d mean_of(std::span<const Vec3d> points) {
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// A point in a polygon near its first corner, and the middle of its first side; or its one corner.
inline Vec3d near_corner(std::span<const Vec3d> polygon) {
  return 0.3 * mean_of(polygon) + 0.7 * polygon.front();
}
inline Vec3d middle_of_side(std::span<const Vec3d> polygon) {
  return 0.5 * (polygon[0] + polygon[1 % polygon.size()]);
}

/// Largest distance of a polygon's corner from its first one, metres.
inline double reach_of(std::span<const Vec3d> polygon) {
  double reach = 0;
  for (const Vec3d& p : polygon) reach = std::max(reach, (p - polygon.front()).norm());
  return reach;
}

/// The part of a convex polygon where the `value` of a corner is not negative (Sutherland and
/// Hodgman 1974). New corners are mix(from, to, value there, value here). Points within `tolerance`
/// of the border count as on it: they stay and make no new corner.
template <class P, class Value, class Mix>
std::vector<P> clipped(const std::vector<P>& polygon, const Value& value, const Mix& mix,
                       double tolerance = 0) {
  std::vector<P> result;
  result.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const P& from = polygon[i];
    const P& to = polygon[(i + 1) % polygon.size()];
    const double at_from = value(from), at_to = value(to);
    if (at_from >= -tolerance) result.push_back(from);
    if (std::min(at_from, at_to) < -tolerance && std::max(at_from, at_to) >= tolerance)
      result.push_back(mix(from, to, at_from, at_to));
  }
  return result;
}

/// Zero of a value that changes linearly from `at_p` to `at_q`. Computed from the lower to the
/// higher end, so that neighbours that share an edge get exactly the same point.
inline Vec3d zero_between(const Vec3d& p, const Vec3d& q, double at_p, double at_q) {
  if (at_p > at_q) return zero_between(q, p, at_q, at_p);
  return p + at_p / (at_p - at_q) * (q - p);
}

/// Cosines and sines of `count` angles in steps of 1 / `steps` of a turn.
inline std::vector<Vec2d> circle(int steps, int count) {
  std::vector<Vec2d> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / steps;
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return points;
}
inline std::vector<Vec2d> circle(int steps) { return circle(steps, steps); }

inline void append(std::vector<Vec3d>& points, std::span<const Vec3d> more) {
  points.insert(points.end(), more.begin(), more.end());
}

}  // namespace contactscope::draw

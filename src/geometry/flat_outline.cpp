#include "geometry/flat_outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "core/convex_polygon.h"
#include "geometry/initial_simplex.h"

namespace contactscope {
namespace {

const Vec2d& at(const std::vector<Vec2d>& points, int i) {
  return points[static_cast<std::size_t>(i)];
}

/// How far point `c` lies to the left of the way from `a` to `b`, times the length of that way.
double left_of(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return cross(Vec2d(b - a), Vec2d(c - a));
}

/// Corners of the convex hull, counter-clockwise, the first of them the leftmost one.
/// Source: Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions".
std::vector<int> corners_around(const std::vector<Vec2d>& flat) {
  std::vector<int> order(flat.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](int i, int j) {
    const Vec2d &p = at(flat, i), &q = at(flat, j);
    if (p.x() != q.x()) return p.x() < q.x();
    return p.y() != q.y() ? p.y() < q.y() : i < j;
  });
  std::vector<int> outline;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t start = outline.size();
    for (; first != last; ++first) {
      while (outline.size() >= start + 2 &&
             left_of(at(flat, outline[outline.size() - 2]), at(flat, outline.back()),
                     at(flat, *first)) <= 0)
        outline.pop_back();
      outline.push_back(*first);
    }
    outline.pop_back();  // the other chain starts with it
  };
  add_chain(order.begin(), order.end());
  add_chain(order.rbegin(), order.rend());
  return outline;
}

/// Whether all corners between two places of the outline lie on the line between those.
bool straight(const std::vector<Vec2d>& flat, const std::vector<int>& outline, std::size_t from,
              std::size_t to, double tolerance) {
  const Vec2d& start = at(flat, outline[from]);
  const Vec2d& end = at(flat, outline[to % outline.size()]);
  const double room = tolerance * (end - start).norm();
  for (std::size_t i = from + 1; i < to; ++i)
    if (std::abs(left_of(start, end, at(flat, outline[i]))) > room) return false;
  return true;
}

}  // namespace

/// Steps: 1. the plane, from points that are far apart; 2. the convex polygon of the points seen
/// along its normal, from its leftmost corner on; 3. from each corner that stays, on to the last one
/// up to which all between are on a line.
std::vector<int> flat_outline(std::span<const Vec3d> points, double tolerance) {
  const auto corner = quickhull::initial_simplex(points, tolerance).points;
  const Vec3d& origin = points[static_cast<std::size_t>(corner[0])];
  const Vec3d x = (points[static_cast<std::size_t>(corner[1])] - origin).normalized();
  const Vec3d third = points[static_cast<std::size_t>(corner[2])] - origin;
  const Vec3d y = (third - third.dot(x) * x).normalized();
  std::vector<Vec2d> flat;
  flat.reserve(points.size());
  for (const Vec3d& point : points) {
    const Vec3d arm = point - origin;
    flat.emplace_back(arm.dot(x), arm.dot(y));
  }

  const std::vector<int> outline = corners_around(flat);
  std::vector<int> kept;
  for (std::size_t from = 0; from < outline.size();) {
    kept.push_back(outline[from]);
    std::size_t to = from + 1;
    while (to < outline.size() && straight(flat, outline, from, to + 1, tolerance)) ++to;
    from = to;
  }
  return kept;
}

}  // namespace contactscope

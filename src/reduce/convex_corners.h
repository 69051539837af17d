#pragma once

#include <tuple>

#include "reduce/steps.h"

namespace contactscope::steps {

template <class S>
using Vec2 = Eigen::Matrix<S, 2, 1>;

template <class S>
struct Corner {
  Vec2<S> place;  // along u and v, relative to point 0
  int index = 0;
};

template <class S>
S cross(const Vec2<S>& a, const Vec2<S>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

template <class S>
using Corners = StaticVector<Corner<S>, 2 * kMaxManifoldPoints>;

/// Andrew's monotone chain (1979): the corners of the convex hull of points that are sorted by x,
/// then y; counter-clockwise, without points on edges. `is_left_turn` looks at three of them.
template <class Points, class IsLeftTurn>
Points convex_chain(const Points& sorted, const IsLeftTurn& is_left_turn) {
  Points hull;
  std::size_t fixed = 0;
  const auto extend = [&](const auto& next) {
    while (hull.size() > fixed + 1 && !is_left_turn(hull[hull.size() - 2], hull.back(), next)) {
      hull.truncate(hull.size() - 1);
    }
    hull.push_back(next);
  };
  for (const auto& point : sorted) extend(point);
  fixed = hull.size() - 1;
  for (std::size_t i = sorted.size() - 1; i-- > 0;) extend(sorted[i]);
  if (hull.size() > 1) hull.truncate(hull.size() - 1);  // the first corner again
  return hull;
}

/// The corners of the points' convex hull along two axes of the plane, counter-clockwise from u to
/// v, without points on edges.
template <class S>
Corners<S> convex_corners(ContactPoints<S> points, const Vec3<S>& u, const Vec3<S>& v) {
  Corners<S> sorted;
  for (int i = 0; i < count_of(points); ++i) {
    const Vec3<S> offset = position(points, i) - position(points, 0);
    sorted.push_back({Vec2<S>(u.dot(offset), v.dot(offset)), i});
  }
  std::ranges::sort(sorted, {}, [](const Corner<S>& corner) {
    return std::tuple(corner.place.x(), corner.place.y(), corner.index);
  });
  return convex_chain(sorted, [](const Corner<S>& a, const Corner<S>& b, const Corner<S>& c) {
    return cross(Vec2<S>(b.place - a.place), Vec2<S>(c.place - b.place)) > S(0);
  });
}

}  // namespace contactscope::steps

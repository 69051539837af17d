#pragma once

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

/// The corners of the points' convex hull along two axes of the plane, counter-clockwise from u to
/// v, without points on edges. Andrew's monotone chain (1979).
template <class S>
Corners<S> convex_corners(ContactPoints<S> points, const Vec3<S>& u, const Vec3<S>& v) {
  Corners<S> sorted;
  for (int i = 0; i < count_of(points); ++i) {
    const Vec3<S> offset = position(points, i) - position(points, 0);
    sorted.push_back({Vec2<S>(u.dot(offset), v.dot(offset)), i});
  }
  std::sort(sorted.begin(), sorted.end(), [](const Corner<S>& a, const Corner<S>& b) {
    if (a.place.x() != b.place.x()) return a.place.x() < b.place.x();
    if (a.place.y() != b.place.y()) return a.place.y() < b.place.y();
    return a.index < b.index;
  });
  Corners<S> hull;
  std::size_t fixed = 0;
  const auto extend = [&](const Corner<S>& next) {
    while (hull.size() > fixed + 1) {
      const Vec2<S> last = hull.back().place - hull[hull.size() - 2].place;
      const Vec2<S> step = next.place - hull.back().place;
      if (cross(last, step) > S(0)) break;
      hull.truncate(hull.size() - 1);
    }
    hull.push_back(next);
  };
  for (const Corner<S>& corner : sorted) extend(corner);
  fixed = hull.size() - 1;
  for (std::size_t i = sorted.size() - 1; i-- > 0;) extend(sorted[i]);
  if (hull.size() > 1) hull.truncate(hull.size() - 1);  // the first corner again
  return hull;
}

}  // namespace contactscope::steps

#include "reduce/newton.h"

#include <algorithm>
#include <array>

#include "reduce/steps.h"

namespace contactscope {
namespace {

template <class S>
using Vec2 = Eigen::Matrix<S, 2, 1>;

template <class S>
struct Corner {
  Vec2<S> place;  // in the plane
  int index = 0;
};

template <class S>
S cross(const Vec2<S>& a, const Vec2<S>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

template <class S>
using Corners = StaticVector<Corner<S>, 2 * kMaxManifoldPoints>;

/// Andrew's monotone chain (1979): counter-clockwise, without points on edges.
template <class S>
Corners<S> convex_hull(Corners<S> sorted) {
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

/// Shamos 1978, "Computational Geometry": the farthest pair is antipodal. As the edge from corner i
/// turns, the corner farthest from it only moves on.
template <class S>
std::array<int, 2> diameter(const Corners<S>& hull) {
  std::array<int, 2> best = {hull[0].index, hull[0].index};
  S most = S(0);
  const auto measure = [&](std::size_t i, std::size_t k) {
    const S length = (hull[i].place - hull[k].place).squaredNorm();
    if (length > most) {
      most = length;
      best = {hull[i].index, hull[k].index};
    }
  };
  const auto after = [&](std::size_t i) { return i + 1 < hull.size() ? i + 1 : 0; };
  std::size_t k = after(0);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2<S> edge = hull[after(i)].place - hull[i].place;
    measure(i, k);
    // Never past corner i, should rounding hold a turn for none.
    while (after(k) != i && cross(edge, Vec2<S>(hull[after(k)].place - hull[k].place)) > S(0)) {
      k = after(k);
      measure(i, k);
    }
    measure(after(i), k);
  }
  return best;
}

}  // namespace

/// Behaviour of Newton, written from a description. Steps: the convex hull of the points in the
/// plane; its diameter by rotating calipers; the farthest points on either side of it. Deviation:
/// where a side is empty three points come back.
template <class S>
KeptIndices reduce_like_newton(std::span<const ContactPoint<S>> points, const Vec3<S>& normal,
                               const ReduceOptions& options) {
  const Vec3<S> u = any_perpendicular(normal);
  const Vec3<S> v = normal.cross(u);
  Corners<S> corners;
  for (int i = 0; i < steps::count(points); ++i) {
    const Vec3<S> offset = steps::at(points, i) - steps::at(points, 0);
    corners.push_back({Vec2<S>(u.dot(offset), v.dot(offset)), i});
  }
  const auto [a, b] = diameter(convex_hull(corners));
  const auto [left, right] = steps::both_sides(points, normal, a, b);
  KeptIndices choices;
  steps::add_once(choices, a);
  steps::add_once(choices, b);
  steps::add_once(choices, left);
  steps::add_once(choices, right);
  return steps::first_of(choices, options);
}

template KeptIndices reduce_like_newton(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                        const ReduceOptions&);
template KeptIndices reduce_like_newton(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                        const ReduceOptions&);

}  // namespace contactscope

#include <array>

#include "reduce/convex_corners.h"

namespace contactscope {
namespace {

/// Shamos 1978, "Computational Geometry": the farthest pair is antipodal. As the edge from corner i
/// turns, the corner farthest from it only moves on.
template <class S>
std::array<int, 2> diameter(const steps::Corners<S>& hull) {
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
    const steps::Vec2<S> edge = hull[after(i)].place - hull[i].place;
    measure(i, k);
    // Never past corner i, should rounding hold a turn for none.
    while (after(k) != i &&
           steps::cross(edge, steps::Vec2<S>(hull[after(k)].place - hull[k].place)) > S(0)) {
      k = after(k);
      measure(i, k);
    }
    measure(after(i), k);
  }
  return best;
}

/// As Newton prunes contacts, written from a description. Steps: the convex hull of the points in
/// the plane; its diameter by rotating calipers; the farthest points on either side of it. Four
/// points at most. Deviation: where a side is empty three points come back.
template <class S>
KeptIndices reduce_like_newton(ContactPoints<S> points, const Vec3<S>& normal,
                               const ReduceOptions& options) {
  const Vec3<S> u = any_perpendicular(normal);
  const auto [a, b] = diameter(steps::convex_corners(points, u, Vec3<S>(normal.cross(u))));
  return steps::two_and_both_sides(points, normal, a, b, options);
}

}  // namespace

ReducerInfo newton_reducer() {
  return {"newton", "the diameter, then both sides", &reduce_like_newton<float>,
          &reduce_like_newton<double>};
}

}  // namespace contactscope

#include "query/blow_up.h"

#include <utility>

namespace contactscope {
namespace {

template <class S>
using StartPoints = std::array<DifferencePoint<S>, 4>;

template <class S>
Vec3<S> start_side(const StartPoints<S>& points, std::size_t i) {
  return points[i].point - points[0].point;
}

/// How far a point is out of what the first `count` points span.
template <class S>
S out_of(const StartPoints<S>& points, int count, const Vec3<S>& point) {
  const Vec3<S> from = point - points[0].point;
  if (count == 1) return from.norm();
  const Vec3<S> along = start_side(points, 1);
  if (count == 2) return along.cross(from).norm() / along.norm();
  const Vec3<S> normal = along.cross(start_side(points, 2));
  return std::abs(normal.dot(from)) / normal.norm();
}

/// The points in an order such that each is the farthest out of those before it, up to where the
/// rest is no farther than `least`; returns how many that are.
template <class S>
int spread(StartPoints<S>& points, int count, S least) {
  if (count > 1) {
    // The longest edge first: what is on it within rounding is between its ends.
    S longest = S(-1);
    std::size_t from = 0, to = 1;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      for (std::size_t j = i + 1; j < static_cast<std::size_t>(count); ++j) {
        const S length = (points[j].point - points[i].point).squaredNorm();
        if (length > longest) longest = length, from = i, to = j;
      }
    }
    std::swap(points[0], points[from]);
    std::swap(points[1], points[to]);
  }
  int kept = 1;
  while (kept < count) {
    int best = kept;
    for (int i = kept + 1; i < count; ++i) {
      if (out_of(points, kept, points[static_cast<std::size_t>(i)].point) >
          out_of(points, kept, points[static_cast<std::size_t>(best)].point)) {
        best = i;
      }
    }
    std::swap(points[static_cast<std::size_t>(kept)], points[static_cast<std::size_t>(best)]);
    if (!(out_of(points, kept, points[static_cast<std::size_t>(kept)].point) > least)) break;
    ++kept;
  }
  return kept;
}

/// Tries a direction and its opposite for the point that reaches farthest out.
template <class S>
void reach_out(const StartPoints<S>& points, int count, const Vec3<S>& direction,
               BoundedDifference<S>& difference, DifferencePoint<S>& best, S& farthest) {
  for (const Vec3<S>& outward : {direction, Vec3<S>(-direction)}) {
    const DifferencePoint<S> found = difference.support(outward);
    const S out = out_of(points, count, found.point);
    if (out > farthest) farthest = out, best = found;
  }
}

}  // namespace

template <class S>
StartSimplex<S> blow_up(const GjkSimplex<S>& simplex, BoundedDifference<S>& difference) {
  StartSimplex<S> start;
  for (const GjkVertex<S>& vertex : simplex.vertices) {
    start.points[static_cast<std::size_t>(start.count)] =
        difference.at({vertex.index_a, vertex.index_b});
    ++start.count;
  }
  const S least = S(2) * difference.rounding();
  start.count = spread(start.points, start.count, least);

  while (start.count < 4) {
    DifferencePoint<S> best = start.points[0];
    S farthest = least;
    if (start.count == 1) {
      start.outward = -difference.difference().between_middles().normalized();
      for (int axis = 0; axis < 3; ++axis) {
        reach_out(start.points, 1, Vec3<S>(Vec3<S>::Unit(axis)), difference, best, farthest);
      }
    } else if (start.count == 2) {
      const Vec3<S> along = start_side(start.points, 1);
      start.outward = perpendicular_to(along);
      const Vec3<S> other = along.cross(start.outward).normalized();
      // 60 degrees apart with their opposites: some point beside the segment is ahead of one.
      const Vec3<S> half = S(0.5) * start.outward, side = S(0.8660254037844386) * other;
      for (const Vec3<S>& direction : {start.outward, Vec3<S>(half + side), Vec3<S>(half - side)}) {
        reach_out(start.points, 2, direction, difference, best, farthest);
      }
    } else {
      const Vec3<S> normal = start_side(start.points, 1).cross(start_side(start.points, 2));
      start.outward = normal / normal.norm();
      reach_out(start.points, 3, start.outward, difference, best, farthest);
    }
    if (!difference.is_finite() || !(farthest > least)) return start;
    start.points[static_cast<std::size_t>(start.count)] = best;
    ++start.count;
  }
  return start;
}

template StartSimplex<float> blow_up(const GjkSimplex<float>&, BoundedDifference<float>&);
template StartSimplex<double> blow_up(const GjkSimplex<double>&, BoundedDifference<double>&);

}  // namespace contactscope

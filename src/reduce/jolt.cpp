#include "reduce/steps.h"

namespace contactscope {
namespace {

/// As Jolt prunes contact points, written from a description. Steps: the point with the largest
/// distance from the centre times depth; the point with the largest distance from that one times
/// depth; the farthest on either side of the line through both. Neither factor counts as less than
/// a floor. Four points at most. Deviations: the centre is that of the points, because a reducer
/// knows no bodies; factors are not squared, which chooses the same and does not underflow; the
/// floor, 1 mm in Jolt, is a thousandth of the patch.
template <class S>
KeptIndices reduce_like_jolt(ContactPoints<S> points, const Vec3<S>& normal,
                             const ReduceOptions& options) {
  const Vec3<S> middle = steps::centre(points);
  const auto reach = [&](const Vec3<S>& from, int i) {
    const Vec3<S> offset = steps::position(points, i) - from;
    return Vec3<S>(offset - normal.dot(offset) * normal).norm();
  };
  S patch = S(0);
  for (int i = 0; i < count_of(points); ++i) patch = std::max(patch, reach(middle, i));
  const S floor = S(0.001) * patch;
  const auto farthest_and_deep = [&](const Vec3<S>& from) {
    return steps::highest(points, -std::numeric_limits<S>::infinity(), [&](int i) {
      const S depth = -at(points, i).separation;
      return std::max(floor, reach(from, i)) * std::max(floor, depth);
    });
  };
  const int first = farthest_and_deep(middle);
  const int second = farthest_and_deep(steps::position(points, first));
  return steps::two_and_both_sides(points, normal, first, second, options);
}

}  // namespace

ReducerInfo jolt_reducer() {
  return {"jolt", "twice distance times depth, then both sides", &reduce_like_jolt<float>,
          &reduce_like_jolt<double>};
}

}  // namespace contactscope

#include "query/overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "query/overlap_axes.h"

namespace contactscope {
namespace {

/// Rounding bound of distances from spheres, in epsilon of the lengths they are sums of: at most 4u
/// for a coordinate in a box's frame, the same for axes orthonormal to 8 epsilon, and 3u for the
/// sum of squares.
constexpr int kDistanceBound = 16;

/// True if two bounds overlap, given the squared distance of their centres and their common reach.
/// `size` is the sum of all lengths that were added.
template <class S>
bool within_reach(S squared, S reach, S size, const Comparison<S>& comparison) {
  const S rounding = S(kDistanceBound) * std::numeric_limits<S>::epsilon() * size;
  if (comparison.touching) {
    const S limit = reach + comparison.tolerance + rounding;
    return squared <= limit * limit;
  }
  const S limit = reach - rounding;
  return limit > 0 && squared < limit * limit;
}

/// Gap along coordinate k, as in the test of two Aabbs.
template <class S>
S gap_along(const Aabb<S>& a, const Aabb<S>& b, int k) {
  return std::max(b.lower[k] - a.upper[k], a.lower[k] - b.upper[k]);
}

template <class S>
bool separated_along(const Aabb<S>& a, const Aabb<S>& b, int k, const Comparison<S>& comparison) {
  if (!comparison.touching) return !(a.lower[k] < b.upper[k] && b.lower[k] < a.upper[k]);
  if (comparison.tolerance == 0) return !(a.lower[k] <= b.upper[k] && b.lower[k] <= a.upper[k]);
  // The difference of close numbers is correct to half an ulp; a sum with the tolerance is not.
  return !(gap_along(a, b, k) <= comparison.tolerance);
}

/// A box and a sphere in the box's frame.
template <class S>
struct BoxAndSphere {
  Vec3<S> half_extents;
  Vec3<S> middle;  // of the sphere, from the box's centre
  Vec3<S> excess;  // of the sphere's centre, from the closest point of the box; zero inside
  S radius;

  S size() const { return middle.template lpNorm<1>() + half_extents.sum() + radius; }

  bool overlap(const Comparison<S>& comparison) const {
    const S all = size() + comparison.tolerance;
    if (!(all <= std::numeric_limits<S>::max())) return false;
    if (!comparison.touching && excess.isZero(0)) {
      // The centre is inside, so only faces measure the depth. A sphere of radius 0 needs this.
      const S rounding = S(kDistanceBound) * std::numeric_limits<S>::epsilon() * all;
      return (middle.cwiseAbs() - half_extents).maxCoeff() - radius < -rounding;
    }
    return within_reach(excess.squaredNorm(), radius, all, comparison);
  }

  /// Records the three axes of the box and the axis to the closest point, if any. No face axis has
  /// a larger gap than that one. `axes`: the box's axes as columns.
  void report(const Mat3<S>& axes, const Comparison<S>& comparison,
              OverlapRecord<S>& record) const {
    const Vec3<S> offset = axes * middle;
    const bool separated = !overlap(comparison);
    for (int k = 0; k < 3; ++k) {
      OverlapAxis<S> axis = overlap_axis<S>(OverlapAxisKind::FaceA, k, -1, axes.col(k), S(1),
                                            offset, std::abs(middle[k]), half_extents[k], radius);
      axis.separates =
          separated && (comparison.touching ? axis.gap > comparison.tolerance : axis.gap >= 0);
      record.axes.push_back(axis);
    }
    const S distance = excess.norm();
    Vec3<S> local = Vec3<S>::Zero();
    if (distance > 0) local = excess / distance;
    OverlapAxis<S> axis =
        overlap_axis<S>(OverlapAxisKind::Closest, -1, -1, axes * local, distance > 0 ? S(1) : S(0),
                        offset, middle.dot(local), half_extents.dot(local.cwiseAbs()), radius);
    if (distance > 0) axis.gap = distance - radius;
    axis.skipped = !(distance > 0);
    axis.separates = separated;
    record.axes.push_back(axis);
  }
};

template <class S>
BoxAndSphere<S> in_box(const Obb<S>& box, const BoundingSphere<S>& sphere) {
  const Vec3<S> offset = sphere.center - box.center;
  const Vec3<S> middle = box.axes.transpose() * offset;
  Vec3<S> excess;
  for (int k = 0; k < 3; ++k)
    excess[k] = std::copysign(std::max(std::abs(middle[k]) - box.half_extents[k], S(0)), middle[k]);
  return {box.half_extents, middle, excess, sphere.radius};
}

/// Uses the coordinates themselves: the box's centre, which rounds far from the origin, is only
/// used for records and bounds.
template <class S>
BoxAndSphere<S> in_box(const Aabb<S>& box, const BoundingSphere<S>& sphere) {
  const Vec3<S> above = sphere.center - box.upper, below = sphere.center - box.lower;
  return {S(0.5) * box.extent(), sphere.center - box.center(),
          above.cwiseMax(S(0)) + below.cwiseMin(S(0)), sphere.radius};
}

template <class S, class Box>
bool box_and_sphere(const Box& box, const BoundingSphere<S>& sphere, const Mat3<S>& axes,
                    const Comparison<S>& comparison, OverlapRecord<S>* record) {
  if (record != nullptr) record->axes.clear();
  if (box.empty() || sphere.empty()) return false;
  const BoxAndSphere<S> local = in_box(box, sphere);
  if (record != nullptr) [[unlikely]]
    local.report(axes, comparison, *record);
  return local.overlap(comparison);
}

}  // namespace

template <class S>
bool overlaps(const Aabb<S>& a, const Aabb<S>& b, const Comparison<S>& comparison,
              OverlapRecord<S>* record) {
  // The most common case, without unpredictable branches.
  if (record == nullptr && comparison.touching && comparison.tolerance == 0) [[likely]]
    return overlaps(a, b) && !a.empty() && !b.empty();
  if (record != nullptr) record->axes.clear();
  if (a.empty() || b.empty()) return false;
  bool result = true;
  for (int k = 0; k < 3; ++k) result = result && !separated_along(a, b, k, comparison);
  if (record == nullptr) [[likely]]
    return result;
  const Vec3<S> offset = b.center() - a.center();
  for (int k = 0; k < 3; ++k) {
    OverlapAxis<S> axis =
        overlap_axis<S>(OverlapAxisKind::FaceA, k, -1, Vec3<S>::Unit(k), 1, offset,
                        std::abs(offset[k]), S(0.5) * a.extent()[k], S(0.5) * b.extent()[k]);
    axis.gap = gap_along(a, b, k);
    axis.separates = separated_along(a, b, k, comparison);
    record->axes.push_back(axis);
  }
  return result;
}

template <class S>
bool overlaps(const BoundingSphere<S>& a, const BoundingSphere<S>& b,
              const Comparison<S>& comparison, OverlapRecord<S>* record) {
  if (record != nullptr) record->axes.clear();
  if (a.empty() || b.empty()) return false;
  const Vec3<S> offset = b.center - a.center;
  const S reach = a.radius + b.radius;
  const bool result =
      within_reach(offset.squaredNorm(), reach,
                   offset.template lpNorm<1>() + reach + comparison.tolerance, comparison);
  if (record != nullptr) [[unlikely]] {
    const S distance = offset.norm();
    record->axes.push_back(overlap_axis<S>(OverlapAxisKind::Closest, -1, -1, offset, distance,
                                           offset, distance * distance, a.radius * distance,
                                           b.radius * distance));
    record->axes.back().length = 1;
    record->axes.back().separates = !result;
  }
  return result;
}

template <class S>
bool overlaps(const Obb<S>& a, const BoundingSphere<S>& b, const Comparison<S>& comparison,
              OverlapRecord<S>* record) {
  return box_and_sphere<S>(a, b, a.axes, comparison, record);
}

template <class S>
bool overlaps(const Aabb<S>& a, const BoundingSphere<S>& b, const Comparison<S>& comparison,
              OverlapRecord<S>* record) {
  return box_and_sphere<S>(a, b, Mat3<S>::Identity(), comparison, record);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                                \
  template bool overlaps(const Aabb<S>&, const Aabb<S>&, const Comparison<S>&, OverlapRecord<S>*); \
  template bool overlaps(const BoundingSphere<S>&, const BoundingSphere<S>&, const Comparison<S>&, \
                         OverlapRecord<S>*);                                                       \
  template bool overlaps(const Aabb<S>&, const BoundingSphere<S>&, const Comparison<S>&,           \
                         OverlapRecord<S>*);                                                       \
  template bool overlaps(const Obb<S>&, const BoundingSphere<S>&, const Comparison<S>&,            \
                         OverlapRecord<S>*);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope

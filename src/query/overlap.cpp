#include "query/overlap.h"

#include "query/fast/box_axes.h"

// Two oriented boxes, `Guarded`: proof that no overlap is lost.
//
// Let t be the offset between the centres, h half extents, u = epsilon / 2. For any vector l,
//
//     f(l) = |t . l| - sum h_k |a_k . l| - sum h_k |b_k . l|
//
// is the gap along l times the length of l. So f(l) > 0 proves that the boxes are separated, for
// any l: it need not be the correct axis. Rounding changes f(l), with l as computed, by at most 5.5
// epsilon |l| D: 4u |t| |l| for t . l with its subtractions, 3u |l| for each a_k . l, 6u for the
// sum. So f(l) > 8 epsilon |l| D guarantees promise 1. It shrinks with |l|. The usual formulas take
// a_k . l from the entries of A^T B; their bound is epsilon D, which hides every gap up to epsilon
// D / |l|.
//
// Promise 2 also needs the right direction of l. In a_i x b_j with nearly parallel edges the
// product cancels. But a_i x b_j = (a_i - b_j) x (a_i + b_j) / 2, where each entry of both factors
// is correct to u relatively. They are perpendicular: nothing cancels, and the direction is correct
// to about 3 epsilon. If one factor is 0, the edges are parallel, and the faces decide (below).
//
// Boxes at distance w have a gap of w / sqrt(3): the direction n between their closest points is a
// sum of at most three of the axes with positive factors, all within an octant of A's or B's own
// axes, so no two of them are more than 90 degrees from each other: n = sum c_m l_m, 1 = |n|^2 >=
// sum c_m^2 >= (sum c_m)^2 / 3, and w = w n . n = sum c_m (gap along l_m) <= sqrt(3) (the largest).
//
// Cost of leaving out an axis n of length s: turn B about n until b_j is parallel to a_i. That
// moves its points by at most s D and keeps the gap g along n. For boxes with parallel edges, some
// face axis has a gap of g / sqrt(2) (a corner in the plane); turned back, g / sqrt(2) - s D. So if
// all faces overlap by more than s D, no such axis separates.
//
// This slow test runs for few pairs. Before it the usual formulas decide, with a bound of 128
// epsilon D on either side: their error is 50 epsilon D for axes orthonormal to 8 epsilon. They
// skip edges parallel to 16 epsilon, and never contradict the slow test.

namespace contactscope {
namespace {

/// Builds a recorded axis from measurements along a direction of any length: the projections are
/// those of the unit direction times `length`. `offset`, metres: from A's centre to B's.
template <class S>
OverlapAxis<S> overlap_axis(OverlapAxisKind kind, int a, int b, const Vec3<S>& direction, S length,
                            const Vec3<S>& offset, S distance, S reach_a, S reach_b) {
  OverlapAxis<S> axis{kind, a, b, Vec3<S>::Zero(), length, {}, {}, 0, false, false};
  if (!(length > 0)) return axis;
  axis.direction = direction / (offset.dot(direction) < 0 ? -length : length);
  axis.interval_a = {-reach_a / length, reach_a / length};
  axis.interval_b = {(distance - reach_b) / length, (distance + reach_b) / length};
  axis.gap = (distance - (reach_a + reach_b)) / length;
  return axis;
}

/// Rounding bound of the distance of two spheres, in epsilon of the lengths it is a sum of: at most
/// u for each coordinate, 3u for the sum of squares, and the rest for the sums with the radii.
constexpr int kDistanceBound = 16;

/// True if two bounds overlap, given the squared distance of their centres and their common reach.
/// `size` is the sum of all lengths that were added.
template <class S> bool within_reach(S squared, S reach, S size, const Comparison<S>& comparison) {
  const S rounding = S(kDistanceBound) * std::numeric_limits<S>::epsilon() * size;
  if (comparison.touching) {
    const S limit = reach + comparison.tolerance + rounding;
    return squared <= limit * limit;
  }
  const S limit = reach - rounding;
  return limit > 0 && squared < limit * limit;
}

/// Gap along coordinate k, as in the test of two Aabbs.
template <class S> S gap_along(const Aabb<S>& a, const Aabb<S>& b, int k) {
  return std::max(b.lower[k] - a.upper[k], a.lower[k] - b.upper[k]);
}

template <class S>
bool separated_along(const Aabb<S>& a, const Aabb<S>& b, int k, const Comparison<S>& comparison) {
  if (!comparison.touching) return !(a.lower[k] < b.upper[k] && b.lower[k] < a.upper[k]);
  if (comparison.tolerance == 0) return !(a.lower[k] <= b.upper[k] && b.lower[k] <= a.upper[k]);
  // The difference of close numbers is correct to half an ulp; a sum with the tolerance is not.
  return !(gap_along(a, b, k) <= comparison.tolerance);
}

using boxes::all;
using boxes::BoxAxes;
using boxes::Projections;
using boxes::Three;

template <class S> constexpr S kEpsilon = std::numeric_limits<S>::epsilon();
/// In units of epsilon D: the quick test is undecided within this bound.
constexpr int kQuickBound = 128;
/// The quick test treats edges as parallel up to this sine, in epsilon.
constexpr int kQuickParallel = 16;
/// Bounds of the slow test, see above. The exclusive one allows for axes that are not exactly
/// orthogonal, so that a face normal is off by 11 epsilon.
constexpr int kInclusiveBound = 8;
constexpr int kExclusiveBound = 24;

enum class Verdict { Separation, Overlap, Undecided };

/// Gaps along three axes, minus the tolerance.
template <class S>
[[gnu::always_inline]] inline Three<S> beyond(const Projections<S>& projections, S tolerance,
                                              const Three<S>& squared_length) {
  Three<S> gap = projections.gap();
  if (tolerance > 0)
    for (int lane = 0; lane < 3; ++lane) gap[lane] -= tolerance * std::sqrt(squared_length[lane]);
  return gap;
}

template <class S> constexpr Three<S> kOnes = {1, 1, 1, 1};

/// Decides cases that are clear beyond rounding. `kTolerant`: there is a tolerance.
template <bool kTolerant, class S>
[[gnu::always_inline]] inline Verdict quick_verdict(const Obb<S>& a, const Obb<S>& b, S tolerance) {
  const BoxAxes<S> axes(a, b);
  if (!kTolerant) tolerance = 0;  // lets the compiler know
  const S bound = S(kQuickBound) * kEpsilon<S> * (axes.size() + tolerance);
  const auto verdict_of = [&](const Three<S>& gaps) {
    // NaN is undecided.
    return gaps[0] > bound || gaps[1] > bound || gaps[2] > bound ? Verdict::Separation
                                                                 : Verdict::Undecided;
  };

  const Three<S> of_a = beyond<S>(axes.faces_of_a(), tolerance, kOnes<S>);
  const Three<S> of_b = beyond<S>(axes.faces_of_b(), tolerance, kOnes<S>);
  const Three<S> faces = lanes::larger(of_a, of_b);
  if (!all<S>(faces <= bound)) return verdict_of(faces);

  const auto edges_0 =
      beyond<S>(axes.template edges<0>(), tolerance, axes.template squared_lengths<0>());
  const auto edges_1 =
      beyond<S>(axes.template edges<1>(), tolerance, axes.template squared_lengths<1>());
  const auto edges_2 =
      beyond<S>(axes.template edges<2>(), tolerance, axes.template squared_lengths<2>());
  const Three<S> edges = lanes::larger(lanes::larger(edges_0, edges_1), edges_2);
  if (!all<S>(edges <= bound)) return verdict_of(edges);
  if (!all<S>(faces < -bound) || !axes.are_boxes()) return Verdict::Undecided;
  if (all<S>(edges < -bound)) return Verdict::Overlap;
  if (kTolerant) return Verdict::Undecided;  // a tolerance applies along short axes as well
  const S parallel = S(kQuickParallel) * kEpsilon<S>;
  const auto clear = ((edges_0 < -bound) | (axes.template rough_lengths<0>() <= parallel)) &
                     ((edges_1 < -bound) | (axes.template rough_lengths<1>() <= parallel)) &
                     ((edges_2 < -bound) | (axes.template rough_lengths<2>() <= parallel));
  return all<S>(clear) ? Verdict::Overlap : Verdict::Undecided;
}

/// Calls visit(kind, i, j, direction) for the fifteen axes until it returns false; returns true if
/// it never did. Directions are not normalized; those of parallel edges are zero.
template <class S, class Visit>
bool for_each_axis(const Obb<S>& a, const Obb<S>& b, const Visit& visit) {
  for (int i = 0; i < 3; ++i)
    if (!visit(OverlapAxisKind::FaceA, i, -1, Vec3<S>(a.axes.col(i)))) return false;
  for (int j = 0; j < 3; ++j)
    if (!visit(OverlapAxisKind::FaceB, -1, j, Vec3<S>(b.axes.col(j)))) return false;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3<S> one = a.axes.col(i), other = b.axes.col(j);
      Vec3<S> sum = one + other, between = one - other;
      if (sum.squaredNorm() < between.squaredNorm()) sum.swap(between);
      if (!visit(OverlapAxisKind::Edges, i, j, Vec3<S>(S(0.5) * between.cross(sum)))) return false;
    }
  }
  return true;
}

/// Measurements of the slow test along one axis, times the length of the axis.
template <class S> struct Measured {
  S distance, reach_a, reach_b, length;
  bool separates;
};

template <class S> S reach_along(const Obb<S>& box, const Vec3<S>& direction) {
  S reach = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3<S> axis = box.axes.col(k);
    reach += box.half_extents[k] * std::abs(axis.dot(direction));
  }
  return reach;
}

template <class S>
Measured<S> measure(const Obb<S>& a, const Obb<S>& b, const Vec3<S>& offset, S size,
                    const Vec3<S>& direction, const Comparison<S>& comparison) {
  Measured<S> found{std::abs(offset.dot(direction)), reach_along(a, direction),
                    reach_along(b, direction), direction.norm(), false};
  if (found.length == 0) return found;
  const S gap =
      found.distance - (found.reach_a + found.reach_b) - comparison.tolerance * found.length;
  const S rounding = kEpsilon<S> * size * found.length;
  found.separates = comparison.touching ? gap > S(kInclusiveBound) * rounding
                                        : gap >= S(-kExclusiveBound) * rounding;
  return found;
}

/// The tests of engines: compare gaps as rounded.
template <class S>
bool plain_overlap(const Obb<S>& a, const Obb<S>& b, const Comparison<S>& comparison,
                   const ObbTest<S>& test) {
  const BoxAxes<S> axes(a, b);
  const S tolerance = comparison.tolerance;
  const auto none_separates = [&](const Three<S>& gap) {
    return comparison.touching ? all<S>(gap <= S(0)) : all<S>(gap < S(0));
  };
  if (!none_separates(lanes::larger(beyond<S>(axes.faces_of_a(), tolerance, kOnes<S>),
                                    beyond<S>(axes.faces_of_b(), tolerance, kOnes<S>))) ||
      !axes.are_boxes())
    return false;
  if (test.axes == ObbAxes::Faces) return true;
  const S shortest = test.skip_up_to * test.skip_up_to;
  const auto edges_pass = [&](const Projections<S>& edges, const Three<S>& squared) {
    // A skipped axis counts as overlapping.
    const Three<S> gap = beyond<S>(edges, tolerance, squared);
    return none_separates(squared <= shortest ? -kOnes<S> : gap);
  };
  return edges_pass(axes.template edges<0>(), axes.template squared_lengths<0>()) &&
         edges_pass(axes.template edges<1>(), axes.template squared_lengths<1>()) &&
         edges_pass(axes.template edges<2>(), axes.template squared_lengths<2>());
}

template <class S> bool all_finite(const Obb<S>& box) {
  return !box.empty() && box.center.allFinite() && box.axes.allFinite() &&
         box.half_extents.allFinite();
}

/// Offset between the centres, and the D of the derivation.
template <class S> struct BoxOffset {
  Vec3<S> offset;
  S size;

  BoxOffset(const Obb<S>& a, const Obb<S>& b, S tolerance)
      : offset(b.center - a.center),
        size(offset.template lpNorm<1>() + (a.half_extents.sum() + b.half_extents.sum()) +
             tolerance) {}
};

/// Not inlined, because few pairs get here.
template <class S>
[[gnu::noinline]] bool slow_overlap(const Obb<S>& a, const Obb<S>& b,
                                    const Comparison<S>& comparison) {
  if (!all_finite(a) || !all_finite(b)) return false;
  const BoxOffset<S> between(a, b, comparison.tolerance);
  return for_each_axis(a, b, [&](OverlapAxisKind, int, int, const Vec3<S>& direction) {
    return !measure(a, b, between.offset, between.size, direction, comparison).separates;
  });
}

/// Records every axis as the slow test measures it. The quick test never contradicts it.
template <class S>
void record_guarded(const Obb<S>& a, const Obb<S>& b, const Comparison<S>& comparison,
                    OverlapRecord<S>& record) {
  const BoxOffset<S> between(a, b, comparison.tolerance);
  for_each_axis(a, b, [&](OverlapAxisKind kind, int i, int j, const Vec3<S>& direction) {
    const auto found = measure(a, b, between.offset, between.size, direction, comparison);
    record.axes.push_back(overlap_axis(kind, i, j, direction, found.length, between.offset,
                                       found.distance, found.reach_a, found.reach_b));
    record.axes.back().skipped = found.length == 0;
    record.axes.back().separates = found.separates;
    return true;
  });
}

/// Records every axis as the plain test measures it.
template <class S>
void record_plain(const Obb<S>& a, const Obb<S>& b, const Comparison<S>& comparison,
                  const ObbTest<S>& test, OverlapRecord<S>& record) {
  const BoxAxes<S> axes(a, b);
  const Vec3<S> offset = b.center - a.center;
  const auto add = [&](OverlapAxisKind kind, int lane, int j, const Vec3<S>& direction,
                       const Projections<S>& projections, const Three<S>& squared) {
    const S length = std::sqrt(squared[lane]);
    const S gap = beyond<S>(projections, comparison.tolerance, squared)[lane];
    const int i = kind == OverlapAxisKind::FaceB ? -1 : lane;
    record.axes.push_back(overlap_axis(kind, i, j, direction, length, offset,
                                       projections.distance[lane], projections.reach_a[lane],
                                       projections.reach_b[lane]));
    OverlapAxis<S>& axis = record.axes.back();
    axis.skipped =
        kind == OverlapAxisKind::Edges && squared[lane] <= test.skip_up_to * test.skip_up_to;
    axis.separates = !axis.skipped && !(comparison.touching ? gap <= 0 : gap < 0);
  };
  for (int i = 0; i < 3; ++i)
    add(OverlapAxisKind::FaceA, i, -1, a.axes.col(i), axes.faces_of_a(), kOnes<S>);
  for (int j = 0; j < 3; ++j)
    add(OverlapAxisKind::FaceB, j, j, b.axes.col(j), axes.faces_of_b(), kOnes<S>);
  if (test.axes == ObbAxes::Faces) return;
  const auto add_edges = [&](int j, const Projections<S>& edges, const Three<S>& squared) {
    for (int i = 0; i < 3; ++i) {
      const Vec3<S> from = a.axes.col(i), to = b.axes.col(j);
      add(OverlapAxisKind::Edges, i, j, from.cross(to), edges, squared);
    }
  };
  add_edges(0, axes.template edges<0>(), axes.template squared_lengths<0>());
  add_edges(1, axes.template edges<1>(), axes.template squared_lengths<1>());
  add_edges(2, axes.template edges<2>(), axes.template squared_lengths<2>());
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

template <class Bound, class S>
using Overlaps = bool(const Bound&, const Bound&, const Comparison<S>&, OverlapRecord<S>*);
template Overlaps<Aabb<float>, float> overlaps;
template Overlaps<Aabb<double>, double> overlaps;
template Overlaps<BoundingSphere<float>, float> overlaps;
template Overlaps<BoundingSphere<double>, double> overlaps;

template <class S>
bool overlaps(const Obb<S>& a, const Obb<S>& b, const Comparison<S>& comparison,
              const ObbTest<S>& test, OverlapRecord<S>* record) {
  if (record != nullptr) [[unlikely]] {
    record->axes.clear();
    if (all_finite(a) && all_finite(b)) {
      if (test.axes == ObbAxes::Guarded)
        record_guarded(a, b, comparison, *record);
      else
        record_plain(a, b, comparison, test, *record);
    }
  }
  if (test.axes != ObbAxes::Guarded) return plain_overlap(a, b, comparison, test);
  const S tolerance = comparison.tolerance;
  const Verdict verdict =
      tolerance > 0 ? quick_verdict<true>(a, b, tolerance) : quick_verdict<false>(a, b, tolerance);
  return verdict == Verdict::Undecided ? slow_overlap(a, b, comparison)
                                       : verdict == Verdict::Overlap;
}

template bool overlaps<float>(const Obb<float>&, const Obb<float>&, const Comparison<float>&,
                              const ObbTest<float>&, OverlapRecord<float>*);
template bool overlaps<double>(const Obb<double>&, const Obb<double>&, const Comparison<double>&,
                               const ObbTest<double>&, OverlapRecord<double>*);

}  // namespace contactscope

#include "manifold/queried_pair.h"

namespace contactscope {
namespace {

template <class S> trace::Volume recorded_volume(const Aabb<S>& box) {
  const Aabb<double> exact = box.template cast<double>();
  return {.center = exact.center(), .half_extents = 0.5 * exact.extent()};
}

template <class S> trace::Volume recorded_volume(const Obb<S>& box) {
  const Obb<double> exact = box.template cast<double>();
  Mat3<double> axes = exact.axes;
  if (axes.determinant() < 0) axes.col(0) *= -1;  // the same box
  return {.center = exact.center,
          .half_extents = exact.half_extents,
          .rotation = Quatd(axes).normalized()};
}

template <class S> trace::Volume recorded_volume(const BoundingSphere<S>& sphere) {
  return {.center = sphere.center.template cast<double>(),
          .radius = static_cast<double>(sphere.radius)};
}

/// Metres, for separated bounds.
template <class S> S distance_of(const Aabb<S>& a, const Aabb<S>& b) {
  const Vec3<S> above = b.lower - a.upper, below = a.lower - b.upper;
  return above.cwiseMax(below).cwiseMax(S(0)).norm();
}

template <class S> S distance_of(const BoundingSphere<S>& a, const BoundingSphere<S>& b) {
  return (b.center - a.center).norm() - (a.radius + b.radius);
}

/// Relative to its centre.
template <class S> std::array<Vec3<S>, 8> corners_of(const Obb<S>& box) {
  std::array<Vec3<S>, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3<S> signs(i & 1 ? S(1) : S(-1), i & 2 ? S(1) : S(-1), i & 4 ? S(1) : S(-1));
    at(corners, i) = box.axes * box.half_extents.cwiseProduct(signs);
  }
  return corners;
}

template <class S> S distance_of(const Obb<S>& a, const Obb<S>& b) {
  const std::array<Vec3<S>, 8> of_a = corners_of(a), of_b = corners_of(b);
  const Pose<S> b_from_a{Quat<S>::Identity(), b.center - a.center};
  return gjk<S>({of_a.data(), 8, nullptr}, {of_b.data(), 8, nullptr}, b_from_a).distance;
}

template <class S> trace::TestedAxis recorded_axis(const OverlapAxis<S>& axis) {
  trace::TestedAxis recorded;
  recorded.kind = to_string(axis.kind);
  recorded.a = axis.kind == OverlapAxisKind::FaceB ? -1 : axis.a;
  recorded.b = axis.kind == OverlapAxisKind::FaceB   ? axis.b
               : axis.kind == OverlapAxisKind::Edges ? axis.b
                                                     : -1;
  recorded.direction = axis.direction.template cast<double>();
  recorded.length = static_cast<double>(axis.length);
  // Relative to the midpoint of the two centres, so that a and b can be swapped.
  const S middle =
      S(0.25) * (axis.interval_a[0] + axis.interval_a[1] + axis.interval_b[0] + axis.interval_b[1]);
  for (std::size_t end = 0; end < 2; ++end) {
    recorded.interval_a[end] = static_cast<double>(axis.interval_a[end] - middle);
    recorded.interval_b[end] = static_cast<double>(axis.interval_b[end] - middle);
  }
  recorded.gap = static_cast<double>(axis.gap);
  recorded.skipped = axis.skipped;
  recorded.separates = axis.separates;
  return recorded;
}

/// The largest separation along the axes that were not skipped, metres.
template <class S> std::optional<S> largest_gap(const OverlapRecord<S>& record) {
  const OverlapAxis<S>* widest = nullptr;
  for (const OverlapAxis<S>& axis : record.axes)
    if (!axis.skipped && !axis.direction.isZero(0) &&
        (!widest || trace::separates_more(axis, *widest, std::numeric_limits<S>::epsilon())))
      widest = &axis;
  return widest ? std::optional<S>(widest->gap) : std::nullopt;
}

/// `overlap(comparison, record)` tests the two bounds.
template <class S, class Bound, class Overlap>
Answer<S> answer_of_bounds(const Bound& a, const Bound& b, const Question& question,
                           trace::Pair* record, const Overlap& overlap) {
  using C = Comparison<S>;
  const S tolerance = static_cast<S>(question.tolerance);
  Answer<S> answer;
  answer.method = *question.bounds;
  OverlapRecord<S> axes;
  answer.overlap = overlap(question.inclusive() ? C::within(tolerance) : C::exclusive(), &axes);
  answer.gap = largest_gap(axes);
  if (question.kind == QueryKind::Touching) {
    const bool deeper =
        tolerance > 0 ? answer.gap && *answer.gap < -tolerance : overlap(C::exclusive(), nullptr);
    answer.touching = answer.overlap && !deeper;
  }
  if (question.kind == QueryKind::Distance && !answer.overlap) answer.gap = distance_of(a, b);
  if (record) [[unlikely]] {
    record->query->bounds_a = recorded_volume(a);
    record->query->bounds_b = recorded_volume(b);
    record->query->axes = mapped(axes.axes, recorded_axis<S>);
  }
  return answer;
}

}  // namespace

template <class S>
Answer<S> query_bounds(const QueriedShape<S>& a, const QueriedShape<S>& b, const Question& question,
                       trace::Pair* record) {
  const auto test = [](const auto& of_a, const auto& of_b, const auto&... axes_tried) {
    return [&](const Comparison<S>& comparison, OverlapRecord<S>* axes) {
      return overlaps(of_a, of_b, comparison, axes_tried..., axes);
    };
  };
  if (*question.bounds == QueryMethod::Aabb) {
    const Aabb<S> of_a = *aabb_of(a.shape, a.pose), of_b = *aabb_of(b.shape, b.pose);
    return answer_of_bounds<S>(of_a, of_b, question, record, test(of_a, of_b));
  }
  if (*question.bounds == QueryMethod::BoundingSphere) {
    const BoundingSphere<S> of_a = placed(*a.bounds.sphere(a.shape), a.pose);
    const BoundingSphere<S> of_b = placed(*b.bounds.sphere(b.shape), b.pose);
    return answer_of_bounds<S>(of_a, of_b, question, record, test(of_a, of_b));
  }
  const Obb<S> of_a = placed(*a.bounds.obb(a.shape), a.pose);
  const Obb<S> of_b = placed(*b.bounds.obb(b.shape), b.pose);
  const ObbTest<S> axes_tried{question.test.axes, static_cast<S>(question.test.skip_up_to)};
  return answer_of_bounds<S>(of_a, of_b, question, record, test(of_a, of_b, axes_tried));
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(query_bounds);

}  // namespace contactscope

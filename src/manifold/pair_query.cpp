#include "manifold/pair_query.h"

#include "manifold/in_double.h"
#include "manifold/queried_pair.h"

namespace contactscope {
namespace {

void record_question(const Question& question, trace::Pair& record) {
  trace::Query& recorded = record.query.emplace();
  recorded.requested = to_string(question.kind);
  recorded.comparison = to_string(question.comparison);
  recorded.tolerance = question.tolerance;
  if (!question.bounds) return;
  recorded.bounds = to_string(*question.bounds);
  if (*question.bounds != QueryMethod::Obb) return;
  recorded.test = to_string(question.test.axes);
  recorded.skip_up_to = question.test.skip_up_to;
}

/// The same numbers in double.
template <class S> Pose<double> wide(const Pose<S>& pose) {
  if constexpr (std::is_same_v<S, float>)
    return in_double(pose);
  else
    return pose;
}
const Shape<double>& wide(const Shape<double>& shape) { return shape; }
Shape<double> wide(const Shape<float>& shape) { return in_double(shape); }

/// `shape` is convex and must outlive the result.
PlacedCore core_of(const Shape<double>& shape, const Pose<double>& pose) {
  static const Vec3d kMiddle = Vec3d::Zero();
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape))
    return {support_set(kMiddle), sphere->radius, pose};
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape))
    return {{capsule->points.data(), 2, nullptr}, capsule->radius, pose};
  return {support_set(std::get<Hull<double>>(shape)), 0, pose};
}

void record_gap(const Gap& gap, const Pose<double>& pose_a, trace::Pair* record) {
  if (record == nullptr || !gap.gap || gap.normal.isZero(0)) return;
  const ToWorld<double> to_world(pose_a);
  record->query->normal = to_world.direction(gap.normal);
  record->query->point_a = to_world.point(gap.on_a);
  record->query->point_b = to_world.point(gap.on_b);
}

/// Two convex shapes, or a convex shape and a plane.
template <class S>
Answer<S> query_solids(const PlacedPair<S>& pair, const Question& question, trace::Pair* record,
                       const trace::Stages& stages, QueryMemory* memory) {
  const Shape<double>&wide_a = wide(pair.a), &wide_b = wide(pair.b);
  const PlacedCore core_a = core_of(wide_a, wide(pair.pose_a));
  const Pose<double> pose_b = wide(pair.pose_b);
  Gap gap;
  if (const auto* plane = std::get_if<HalfSpace<double>>(&wide_b)) {
    gap = gap_to_plane(core_a, *plane, pose_b, kEpsilon<S>);
  } else {
    std::optional<Recorder<double>> recorder;
    if (record) recorder.emplace(ToWorld<double>(core_a.given), stages, *record);
    gap = gap_of_cores(core_a, core_of(wide_b, pose_b), question, kEpsilon<S>,
                       recorder ? &*recorder : nullptr, memory);
  }
  record_gap(gap, core_a.given, record);
  return answer_of<S>(gap, question);
}

template <class S>
Answer<S> answer_where_near(const std::optional<Gap>& gap, const Question& question) {
  if (gap) return answer_of<S>(*gap, question);
  Answer<S> distance;
  distance.method = QueryMethod::Contacts;
  if (question.kind == QueryKind::Touching) distance.touching = false;
  return distance;
}

/// All contacts with a mesh or a field within the margin. The record does not keep their manifolds.
template <class S>
Manifolds<S> contacts_within(double margin, const PlacedPair<S>& pair, trace::Pair* record,
                             const trace::Stages& stages) {
  CollideOptions options;
  options.margin = margin;
  options.preference = Preference::None;
  options.internal_edges = false;
  options.mesh_manifolds = MeshManifolds::Triangle;
  Manifolds<S> manifolds;
  collide(pair.a, pair.pose_a, pair.b, pair.pose_b, options, manifolds, nullptr, record, stages);
  if (record) [[unlikely]] {
    record->manifolds.clear();
    record->separation = 0;
  }
  return manifolds;
}

/// A convex shape and the surface of a mesh.
template <class S>
Answer<S> query_mesh(const PlacedPair<S>& pair, const Question& question, trace::Pair* record,
                     const trace::Stages& stages) {
  const Shape<double>& wide_a = wide(pair.a);
  const PlacedCore core = core_of(wide_a, wide(pair.pose_a));
  std::optional<Gap> gap =
      gap_to_mesh(core, std::get<Mesh<S>>(pair.b), wide(pair.pose_b), question);
  if (gap) gap->method = QueryMethod::Contacts;
  if (record) contacts_within(question.tolerance, pair, record, stages);
  if (gap) record_gap(*gap, core.given, record);
  return answer_where_near<S>(gap, question);
}

/// Any shape and a field, by their contacts.
template <class S>
Answer<S> query_field(const PlacedPair<S>& pair, const Question& question, trace::Pair* record,
                      const trace::Stages& stages) {
  const Pose<double> wide_a = wide(pair.pose_a), wide_b = wide(pair.pose_b);
  const Aabb<double> box = aabb_of(pair.b)->template cast<double>();
  const double reach = box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).norm();
  const double bound =
      bound_of_rounding(wide_a.position.norm() + wide_b.position.norm() + 2 * reach, kEpsilon<S>);
  std::optional<Gap> gap;
  for (const Manifold<S>& manifold :
       contacts_within(question.tolerance + bound, pair, record, stages))
    for (const ContactPoint<S>& point : manifold.points)
      if (!gap || static_cast<double>(point.separation) < *gap->gap)
        gap = {.gap = static_cast<double>(point.separation),
               .method = QueryMethod::Contacts,
               .normal = manifold.normal.template cast<double>(),
               .on_b = point.position.template cast<double>()};
  if (gap) {
    const auto along = [&](const Pose<double>& pose) {
      return rounding_along(gap->normal, pose, pose.inverse_transform(gap->on_b), kEpsilon<S>);
    };
    gap->rounding = bound_of_rounding(reach, 0) + along(wide_a) + along(wide_b);
    if (*gap->gap > question.tolerance + gap->rounding) gap.reset();
  }
  if (gap && record) [[unlikely]] {
    record->query->normal = gap->normal;
    record->query->point_b = gap->on_b;
  }
  return answer_where_near<S>(gap, question);
}

/// Queries the shapes themselves, in the order of the table.
template <class S>
Answer<S> query_any_shapes(const QueriedShape<S>& a, const QueriedShape<S>& b,
                           const Question& question, trace::Pair* record,
                           const trace::Stages& stages, QueryMemory* memory) {
  const PlacedPair<S> pair{a.shape, a.pose, b.shape, b.pose};
  if (kind_of(b.shape) == ShapeKind::Field) return query_field(pair, question, record, stages);
  if (const auto* mesh = std::get_if<Mesh<S>>(&a.shape))
    return query_meshes(*mesh, a.pose, std::get<Mesh<S>>(b.shape), b.pose, question,
                        stages.query ? record : nullptr, stages, memory ? &memory->front : nullptr);
  if (kind_of(b.shape) == ShapeKind::Mesh) return query_mesh(pair, question, record, stages);
  return query_solids(pair, question, record, stages, memory);
}

/// The shapes' own answer, next to a query of their bounds.
template <class S>
trace::WithinBounds within_bounds(const QueriedShape<S>& a, const QueriedShape<S>& b,
                                  Question question) {
  question.kind = QueryKind::Overlap;
  question.bounds.reset();
  if (kind_of(a.shape) == ShapeKind::Mesh && kind_of(b.shape) == ShapeKind::Mesh)
    question.tolerance = 0;
  const Answer<S> answer = query_any_shapes(a, b, question, nullptr, kUsualStages, nullptr);
  trace::WithinBounds recorded;
  recorded.overlap = answer.overlap;
  if (answer.gap) recorded.gap = static_cast<double>(*answer.gap);
  return recorded;
}

/// `a` and `b` are in the order of the table.
template <class S>
Answer<S> query_in_order(const QueriedShape<S>& a, const QueriedShape<S>& b,
                         const Question& question, trace::Pair* record, const trace::Stages& stages,
                         QueryMemory* memory) {
  if (!question.bounds) return query_any_shapes(a, b, question, record, stages, memory);
  trace::Pair* const recorded = stages.query ? record : nullptr;
  if (recorded) recorded->query->shapes = within_bounds(a, b, question);
  return query_bounds(a, b, question, recorded);
}

}  // namespace

std::optional<std::string> refusal(const Question& question, ShapeKind one, ShapeKind other) {
  if (question.kind == QueryKind::Manifold) return refusal(question.kind, one, other);
  if (!question.bounds) {
    if (one == ShapeKind::Mesh && other == ShapeKind::Mesh && question.tolerance > 0 &&
        question.kind == QueryKind::Overlap)
      return "the triangles of two meshes are compared exactly; remove 'tolerance', or ask bounds "
             "first, bounds = \"aabb\"";
    return refusal(question.kind, one, other);
  }
  if (question.kind == QueryKind::Penetration)
    return "bounds are larger than what is in them, and how deep they are says nothing of it; ask "
           "\"overlap\", \"touching\" or \"distance\" of them, or remove 'bounds'";
  return refusal(*question.bounds, QueryKind::Overlap, one, other);
}

template <class S>
Answer<S> query_pair(const QueriedShape<S>& a, const QueriedShape<S>& b, const Question& question,
                     bool b_first, trace::Pair* record, const trace::Stages& stages,
                     QueryMemory* memory) {
  const ShapeKind kind_a = kind_of(a.shape), kind_b = kind_of(b.shape);
  const bool swapped = kind_a == kind_b ? b_first : kind_a > kind_b;
  const QueriedShape<S>&first = swapped ? b : a, &second = swapped ? a : b;
  if (record == nullptr) return query_in_order(first, second, question, nullptr, stages, memory);
  if (swapped) std::swap(record->a, record->b);
  record->kind = pair_kind(first.shape, second.shape);
  record_question(question, *record);
  const Answer<S> answer = query_in_order(first, second, question, record, stages, memory);
  record->query->method = to_string(answer.method);
  record->query->touching = answer.touching;
  if (answer.gap) record->query->gap = static_cast<double>(*answer.gap);
  if (swapped) trace::mirror(*record);
  record_answer(answer, *record);
  return answer;
}

template <class S> void record_answer(const Answer<S>& answer, trace::Pair& record) {
  record.state = answer.overlap ? "touching" : "separated";
  record.overlap = answer.overlap;
  if (answer.gap) record.separation = static_cast<double>(*answer.gap);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(query_pair, record_answer);

}  // namespace contactscope

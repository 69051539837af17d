#include "manifold/ask.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "manifold/asked_pair.h"
#include "manifold/in_double.h"

namespace contactscope {
namespace {

void record_question(const Question& question, trace::Pair& record) {
  trace::Query& told = record.query.emplace();
  told.asked = to_string(question.kind);
  told.comparison = question.inclusive ? "inclusive" : "exclusive";
  told.tolerance = question.tolerance;
  if (!question.bounds) return;
  told.bounds = to_string(*question.bounds);
  if (*question.bounds != QueryMethod::Obb) return;
  told.test = to_string(question.test.axes);
  told.skip_up_to = question.test.skip_up_to;
}

template <class S>
void record_gap(const Gap<S>& gap, const Pose<S>& pose_a, trace::Query& told) {
  if (!gap.gap || gap.normal.isZero(0)) return;
  const ToWorld<S> to_world(pose_a);
  told.normal = to_world.direction(gap.normal).template cast<double>();
  told.point_a = to_world.point(gap.on_a).template cast<double>();
  told.point_b = to_world.point(gap.on_b).template cast<double>();
}

/// In the order of the table, without a plane or a mesh.
template <class S>
Answer<S> ask_convex(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                     const Pose<S>& pose_b, const Question& question, trace::Pair* record,
                     const trace::Stages& stages) {
  const Pose<S> b_in_a = relative_pose(pose_a, pose_b);
  if (record == nullptr)
    return answer_of(gap_of_cores<S>(a, b, b_in_a, question, nullptr), question);
  Recorder<S> recorder(ToWorld<S>(pose_a), stages, *record);
  const Gap<S> gap = gap_of_cores(a, b, b_in_a, question, &recorder);
  record_gap(gap, pose_a, *record->query);
  return answer_of(gap, question);
}

/// A convex shape and the surface of a mesh, or any shape and a field: their contacts, which are not
/// kept.
template <class S>
Answer<S> ask_contacts(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                       const Pose<S>& pose_b, const Question& question, trace::Pair* record,
                       const trace::Stages& stages) {
  // Of coordinates in the frame of the mesh, where triangles are compared each in a frame of its
  // own: a rotation and a sum.
  constexpr int kRounding = 8;
  Gap<S> gap;
  gap.method = QueryMethod::Contacts;
  gap.rounding = S(kRounding) * std::numeric_limits<S>::epsilon() *
                 relative_pose(pose_b, pose_a).position.norm();
  CollideOptions options;
  options.margin = question.tolerance + static_cast<double>(gap.rounding);
  options.preference = Preference::None;
  options.internal_edges = false;
  Manifolds<S> manifolds;
  collide(a, pose_a, b, pose_b, options, manifolds, nullptr, record, stages);
  for (const Manifold<S>& manifold : manifolds)
    for (const ContactPoint<S>& point : manifold.points)
      if (!gap.gap || point.separation < *gap.gap) {
        gap.gap = point.separation;
        gap.normal = manifold.normal;
        gap.on_b = point.position;
      }
  if (record) [[unlikely]] {
    record->manifolds.clear();
    record->separation = 0;
    if (gap.gap) {
      record->query->normal = gap.normal.template cast<double>();
      record->query->point_b = gap.on_b.template cast<double>();
    }
  }
  if (gap.gap) return answer_of(gap, question);
  Answer<S> apart;
  apart.method = gap.method;
  if (question.kind == QueryKind::Touching) apart.touching = false;
  return apart;
}

/// Of the shapes themselves, in the order of the table.
template <class S>
Answer<S> ask_shapes(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                     const Pose<S>& pose_b, const Question& question, trace::Pair* record,
                     const trace::Stages& stages, MeshFront* front) {
  if (kind_of(b) == ShapeKind::Field)
    return ask_contacts(a, pose_a, b, pose_b, question, record, stages);
  if (const auto* mesh = std::get_if<Mesh<S>>(&a))
    return ask_meshes(*mesh, pose_a, std::get<Mesh<S>>(b), pose_b, question,
                      stages.query ? record : nullptr, stages, front);
  if (kind_of(b) == ShapeKind::Mesh)
    return ask_contacts(a, pose_a, b, pose_b, question, record, stages);
  if (const auto* plane = std::get_if<HalfSpace<S>>(&b)) {
    const Gap<S> gap = gap_to_plane(a, *plane, relative_pose(pose_a, pose_b));
    if (record) [[unlikely]]
      record_gap(gap, pose_a, *record->query);
    return answer_of(gap, question);
  }
  if constexpr (std::is_same_v<S, float>) {
    if (belongs_in_double(a, b)) [[unlikely]] {
      const Answer<double> wide = ask_convex(in_double(a), in_double(pose_a), in_double(b),
                                             in_double(pose_b), question, record, stages);
      Answer<float> answer{wide.overlap, wide.touching, {}, wide.method, {}};
      if (wide.gap) answer.gap = static_cast<float>(*wide.gap);
      return answer;
    }
  }
  return ask_convex(a, pose_a, b, pose_b, question, record, stages);
}

/// What the shapes say where their bounds are asked.
template <class S>
trace::WithinBounds within_bounds(const AskedShape<S>& a, const AskedShape<S>& b,
                                  Question question) {
  question.kind = QueryKind::Overlap;
  question.bounds.reset();
  if (kind_of(a.shape) == ShapeKind::Mesh && kind_of(b.shape) == ShapeKind::Mesh)
    question.tolerance = 0;
  const Answer<S> answer =
      ask_shapes<S>(a.shape, a.pose, b.shape, b.pose, question, nullptr, kUsualStages, nullptr);
  trace::WithinBounds told;
  told.overlap = answer.overlap;
  if (answer.gap) told.gap = static_cast<double>(*answer.gap);
  return told;
}

/// In the order of the table.
template <class S>
Answer<S> ask_in_order(const AskedShape<S>& a, const AskedShape<S>& b, const Question& question,
                       trace::Pair* record, const trace::Stages& stages, MeshFront* front) {
  if (!question.bounds)
    return ask_shapes<S>(a.shape, a.pose, b.shape, b.pose, question, record, stages, front);
  trace::Pair* const told = stages.query ? record : nullptr;
  if (told) [[unlikely]]
    told->query->shapes = within_bounds(a, b, question);
  return ask_bounds(a, b, question, told);
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
Answer<S> ask(const AskedShape<S>& a, const AskedShape<S>& b, const Question& question,
              bool b_first, trace::Pair* record, const trace::Stages& stages, MeshFront* front) {
  const ShapeKind kind_a = kind_of(a.shape), kind_b = kind_of(b.shape);
  const bool traded = kind_a == kind_b ? b_first : kind_a > kind_b;
  if (record == nullptr)
    return ask_in_order(traded ? b : a, traded ? a : b, question, nullptr, stages, front);
  if (traded) std::swap(record->a, record->b);
  record->kind = pair_kind((traded ? b : a).shape, (traded ? a : b).shape);
  record_question(question, *record);
  const Answer<S> answer =
      ask_in_order(traded ? b : a, traded ? a : b, question, record, stages, front);
  record->query->method = to_string(answer.method);
  record->query->touching = answer.touching;
  if (answer.gap) record->query->gap = static_cast<double>(*answer.gap);
  if (traded) trace::mirror(*record);
  record_answer(answer, *record);
  return answer;
}

template <class S>
void record_answer(const Answer<S>& answer, trace::Pair& record) {
  record.state = answer.overlap ? "touching" : "separated";
  record.overlap = answer.overlap;
  if (answer.gap) record.separation = static_cast<double>(*answer.gap);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                         \
  template Answer<S> ask(const AskedShape<S>&, const AskedShape<S>&, const Question&, bool, \
                         trace::Pair*, const trace::Stages&, MeshFront*);                   \
  template void record_answer(const Answer<S>&, trace::Pair&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope

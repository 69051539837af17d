#pragma once

#include "manifold/ask.h"
#include "manifold/recorder.h"

/// The ways in which ask() answers, each in the file of its name. All work in A's frame; what they
/// tell goes into `query` of the record, in the world.
namespace contactscope {

/// What is known of two shapes as a whole, in A's frame, metres.
template <class S>
struct Gap {
  std::optional<S> gap{};  // negative: how deep; empty: they overlap, by nobody knows how much
  S rounding = 0;          // gaps up to this count as none
  QueryMethod method = QueryMethod::Gjk;
  Vec3<S> normal = Vec3<S>::Zero();  // unit, from A to B; zero where the method has none
  Vec3<S> on_a = Vec3<S>::Zero(), on_b = Vec3<S>::Zero();  // closest or deepest, with a normal
};

/// The answer that follows from a gap.
template <class S>
Answer<S> answer_of(const Gap<S>& gap, const Question& question) {
  Answer<S> answer;
  answer.method = gap.method;
  answer.gap = gap.gap;
  const S tolerance = static_cast<S>(question.tolerance);
  // Where nobody knows how much they overlap, it is more than rounding, or not asked.
  const bool deep = !gap.gap;
  const bool within = deep || *gap.gap <= tolerance + gap.rounding;
  answer.overlap = question.inclusive ? within : deep || *gap.gap < -gap.rounding;
  if (question.kind == QueryKind::Touching)
    answer.touching = within && !deep && *gap.gap >= -(tolerance + gap.rounding);
  return answer;
}

/// Two convex shapes.
template <class S>
Gap<S> gap_of_cores(const Shape<S>& a, const Shape<S>& b, const Pose<S>& b_in_a,
                    const Question& question, Recorder<S>* recorder);

/// A convex shape and a plane.
template <class S>
Gap<S> gap_to_plane(const Shape<S>& a, const HalfSpace<S>& b, const Pose<S>& b_in_a);

/// Two meshes. The record gets their intersections, and which nodes were compared where the stages
/// ask for it.
template <class S>
Answer<S> ask_meshes(const Mesh<S>& a, const Pose<S>& pose_a, const Mesh<S>& b,
                     const Pose<S>& pose_b, const Question& question, trace::Pair* record,
                     const trace::Stages& stages, MeshFront* front);

/// Their bounds. The record gets the bounds and the axes.
template <class S>
Answer<S> ask_bounds(const AskedShape<S>& a, const AskedShape<S>& b, const Question& question,
                     trace::Pair* record);

}  // namespace contactscope

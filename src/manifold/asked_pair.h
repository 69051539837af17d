#pragma once

#include <limits>

#include "manifold/ask.h"
#include "manifold/recorder.h"
#include "query/support_set.h"

/// The ways in which ask() answers, each in the file of its name. All work in A's frame; what they
/// record goes into `query` of the record, in the world.
namespace contactscope {

/// A convex shape as the points within `radius` of its core, in double whatever its numbers were
/// given in. Refers to what it was made of.
struct PlacedCore {
  SupportSet<double> set;
  double radius = 0;  // metres
  Pose<double> given;
  Vec3d origin = Vec3d::Zero();  // of the set's frame in that of `given`, which has the same axes

  Pose<double> pose() const { return {given.rotation, given.transform(origin)}; }
  bool has_volume() const { return set.hull != nullptr; }
};

/// What is known of two shapes as a whole, in A's frame, metres. In double, also of shapes in float:
/// what is computed is then exact next to what rounding made of the numbers that were given.
struct Gap {
  std::optional<double> gap{};  // negative: how deep; empty: they overlap, by nobody knows how much
  double rounding = 0;          // gaps up to this count as none, see rounding_along()
  QueryMethod method = QueryMethod::Gjk;
  Vec3d normal = Vec3d::Zero();  // unit, from A to B; zero where the method has none
  Vec3d on_a = Vec3d::Zero(), on_b = Vec3d::Zero();  // closest or deepest, with a normal
};

/// The answer that follows from a gap: the one rule of what overlaps and what touches.
template <class S>
Answer<S> answer_of(const Gap& gap, const Question& question) {
  Answer<S> answer;
  answer.method = gap.method;
  if (gap.gap) answer.gap = static_cast<S>(*gap.gap);
  const double allowed = question.tolerance + gap.rounding;
  // Where nobody knows how much they overlap, it is more than rounding, or does not matter.
  const bool deep = !gap.gap;
  const bool within = deep || *gap.gap <= allowed;
  answer.overlap = question.inclusive ? within : deep || *gap.gap < -gap.rounding;
  if (question.kind == QueryKind::Touching)
    answer.touching = within && !deep && *gap.gap >= -allowed;
  return answer;
}

/// The epsilon of the scalar in which shapes and poses were given.
using Epsilon = double;
template <class S>
constexpr Epsilon kEpsilon = static_cast<double>(std::numeric_limits<S>::epsilon());

/// How far a point of a shape moves along an axis, metres, where each number that says where it is
/// changes by one epsilon of itself, which is two roundings: the position of its frame, the four
/// numbers of its rotation, and `in_frame`, its coordinates there. To first order. `normal` is unit, in
/// the world. A level floor's corners, however far out, move with its height and thickness alone; an
/// inclined one has large coordinates along the normal that cancel, and their rounding is there.
double rounding_along(const Vec3d& normal, const Pose<double>& pose, const Vec3d& in_frame,
                      Epsilon epsilon);

/// Nothing that rounding_along() gives of two shapes is larger; `lengths` is the sum of how far each
/// reaches from its frame's origin and how far these are from the world's.
double bound_of_rounding(double lengths, Epsilon epsilon);

/// Two convex shapes. Computed by GJK and, where cores overlap, by the separating axis test or the method
/// of the question. `recorder` is of double.
Gap gap_of_cores(const PlacedCore& a, const PlacedCore& b, const Question& question,
                 Epsilon epsilon, Recorder<double>* recorder);

/// A convex shape and a plane.
Gap gap_to_plane(const PlacedCore& a, const HalfSpace<double>& b, const Pose<double>& pose_b,
                 Epsilon epsilon);

/// A convex shape and the surface of a mesh: its triangle of least gap. Empty where none is nearer than
/// what counts as none.
template <class S>
std::optional<Gap> gap_to_mesh(const PlacedCore& a, const Mesh<S>& b, const Pose<double>& pose_b,
                               const Question& question);

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

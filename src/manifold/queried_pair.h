#pragma once

#include "manifold/pair_query.h"
#include "manifold/recorder.h"

/// The methods of query_pair(), in files of their names: in A's frame; they record in the world.
namespace contactscope {

/// A convex shape as the points within `radius` of its core, in double. Refers to that shape.
struct PlacedCore {
  SupportSet<double> set;
  double radius = 0;  // metres
  Pose<double> given;
  Vec3d origin = Vec3d::Zero();  // of the set's frame in `given`'s frame, with the same axes
  Pose<double> pose() const { return {given.rotation, given.transform(origin)}; }
  bool has_volume() const { return set.hull != nullptr; }
};

/// Separation of two shapes as a whole, in A's frame, metres. In double also for float shapes: the
/// computation is then exact compared with the rounding of the input.
struct Gap {
  std::optional<double> gap{};  // negative: depth; empty: they overlap by an unknown depth
  double rounding = 0;          // separations up to this count as zero, see rounding_along()
  QueryMethod method = QueryMethod::Gjk;
  Vec3d normal = Vec3d::Zero();  // unit, from A to B; zero where the method has none
  Vec3d on_a = Vec3d::Zero(), on_b = Vec3d::Zero();  // closest or deepest, if there is a normal
};

/// The answer that follows from a separation: the only rule for overlap and touching.
template <class S> Answer<S> answer_of(const Gap& gap, const Question& question) {
  Answer<S> answer;
  answer.method = gap.method;
  if (gap.gap) answer.gap = static_cast<S>(*gap.gap);
  const double allowed = question.tolerance + gap.rounding;
  // An unknown depth is more than rounding, or does not matter.
  const bool deep = !gap.gap;
  const bool within = deep || *gap.gap <= allowed;
  answer.overlap = question.inclusive() ? within : deep || *gap.gap < -gap.rounding;
  if (question.kind == QueryKind::Touching)
    answer.touching = within && !deep && *gap.gap >= -allowed;
  return answer;
}

/// The epsilon of the scalar in which shapes and poses were given.
using Epsilon = double;
template <class S>
constexpr Epsilon kEpsilon = static_cast<double>(std::numeric_limits<S>::epsilon());

/// How far a point of a shape moves along an axis, metres, when each number that places it changes
/// by one epsilon of itself (two roundings): the position of its frame, the four numbers of its
/// rotation, and `in_frame`, its coordinates there. First order. `normal` is unit, in the world.
/// Corners of a level floor, however far out, move with its height and thickness alone. An inclined
/// floor has large coordinates along the normal that cancel, so their rounding counts.
double rounding_along(const Vec3d& normal, const Pose<double>& pose, const Vec3d& in_frame,
                      Epsilon epsilon);

/// Upper bound of rounding_along() for two shapes. `lengths` is the sum of each shape's reach from
/// its frame's origin and of the distances of these origins from the world's.
double bound_of_rounding(double lengths, Epsilon epsilon);

/// Two convex shapes: GJK and, where the cores overlap, the separating axis test or the query's
/// penetration method. `recorder` is of double. GJK and V-Clip start where `memory` says, unless it
/// is null, and leave their end there.
Gap gap_of_cores(const PlacedCore& a, const PlacedCore& b, const Question& question,
                 Epsilon epsilon, Recorder<double>* recorder, QueryMemory* memory = nullptr);

Gap gap_to_plane(const PlacedCore& a, const HalfSpace<double>& b, const Pose<double>& pose_b,
                 Epsilon epsilon);

/// Convex shape and the surface of a mesh: the triangle of least separation. Empty if every
/// triangle is beyond the separations that count as zero.
template <class S>
std::optional<Gap> gap_to_mesh(const PlacedCore& a, const Mesh<S>& b, const Pose<double>& pose_b,
                               const Question& question);

/// Two meshes. Records their intersections and, if the stages include it, the compared nodes.
template <class S>
Answer<S> query_meshes(const Mesh<S>& a, const Pose<S>& pose_a, const Mesh<S>& b,
                       const Pose<S>& pose_b, const Question& question, trace::Pair* record,
                       const trace::Stages& stages, MeshFront* front);

/// Bounds of two shapes. Records the bounds and the axes.
template <class S>
Answer<S> query_bounds(const QueriedShape<S>& a, const QueriedShape<S>& b, const Question& question,
                       trace::Pair* record);

}  // namespace contactscope

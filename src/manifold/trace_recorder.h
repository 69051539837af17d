#pragma once

#include "manifold/recorder.h"
#include "manifold/to_world.h"
#include "trace/trace.h"

namespace contactscope {

/// Writes what each stage decided into a trace::Pair: from A's frame to the world in the pipeline's
/// own scalar, then exactly to double. A mirrored record is told as if the shapes had been given
/// the other way round.
template <class S>
class TraceRecorder {
 public:
  static constexpr bool kRecords = true;

  /// `pair` must outlive this; its names of the shapes are set already, in the order of the record.
  /// Stages are emptied.
  TraceRecorder(const ToWorld<S>& to_world, const char* reducer_name, const trace::Stages& stages,
                bool mirrored, trace::Pair& pair);

  void axes(const HullPair<S>& pair, const SatResult<S>& axes, Preference preference);
  /// What the pair's cache held was tried.
  void cache(const CacheAnswer<S>& answer);
  /// `reference` owns the first face.
  void clip_begins(Owner reference, const ClipFace<S>& reference_face,
                   const ClipFace<S>& incident_face);
  /// A side plane of the reference face and what it left.
  void clip_step(const Plane<S>& side, const ClipPolygon<S>& polygon);
  void dropped(const Vec3<S>& position, const char* reason);
  /// The face contact is given up for another axis.
  void clip_abandoned();
  /// The axis that made the contact, when it is not the one that the test chose.
  void contact_axis(AxisKind kind);
  /// `points` and `normal` in the world.
  void reduction(std::span<const ContactPoint<S>> points, const Vec3<S>& normal, int max_points,
                 const KeptIndices& kept);
  GjkRun<S>* gjk_run() { return stages_.gjk ? &gjk_run_ : nullptr; }
  /// The run that was left in gjk_run(), if any; `frame` places what it worked in in A's frame.
  void gjk(const Pose<S>& frame);
  PenetrationSteps<S>* penetration_steps() {
    return stages_.penetration ? &penetration_steps_ : nullptr;
  }
  /// What a method found, in A's frame, with the steps that were left in penetration_steps();
  /// `fallback` names the method whose result stands instead, or is nullptr.
  void penetration(PenetrationMethod method, const PenetrationResult<S>& result,
                   const char* fallback);
  /// The Minkowski difference of two hulls.
  void minkowski(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a);
  /// The query of a mesh's tree with the other shape's box; both in the mesh's frame.
  void tree(const Mesh<S>& mesh, const Aabb<S>& box);
  /// The geometry had no normal of its own; what was done about it.
  void degenerate(const char* geometry, Degenerate answer);
  /// Of the pair, metres: what stands in the record when no point does.
  void separation(S separation);
  /// A result, in the world; also decides the state.
  void manifold(const Manifold<S>& result);

 private:
  Vec3d point(const Vec3<S>& in_a) const;
  Vec3d direction(const Vec3<S>& in_a) const;
  /// From the record's a to its b.
  Vec3d normal(const Vec3<S>& in_a) const;
  const std::string& name(Owner owner) const;
  AxisKind told(AxisKind kind) const { return mirrored_ ? contactscope::mirrored(kind) : kind; }
  void edge_pairs(const HullPair<S>& pair, trace::Sat& sat) const;
  trace::Point trace_point(const ContactPoint<S>& in_world) const;
  std::vector<trace::Point> trace_points(std::span<const ContactPoint<S>> in_world) const;
  trace::Polygon polygon(const ClipPolygon<S>& in_a) const;

  ToWorld<S> to_world_;
  const char* reducer_name_;
  trace::Stages stages_;
  bool mirrored_;
  trace::Pair& pair_;
  GjkRun<S> gjk_run_;
  PenetrationSteps<S> penetration_steps_;
};

}  // namespace contactscope

#pragma once

#include "manifold/recorder.h"
#include "manifold/to_world.h"
#include "trace/trace.h"

namespace contactscope {

/// Writes what each stage decided into a trace::Pair: from A's frame to the world in the pipeline's
/// own scalar, then exactly to double.
template <class S>
class TraceRecorder {
 public:
  static constexpr bool kRecords = true;

  /// `pair` must outlive this; its names of the shapes are set already. Stages are emptied.
  TraceRecorder(const ToWorld<S>& to_world, const char* reducer_name, const trace::Stages& stages,
                trace::Pair& pair);

  void axes(const HullPair<S>& pair, const SatResult<S>& axes, Preference preference);
  void clip_begins(const HullPair<S>& pair, Owner reference, int reference_face, int incident_face,
                   const ClipPolygon<S>& reference_polygon, const ClipPolygon<S>& incident_polygon);
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
  /// The result, in the world; also decides the state.
  void manifold(const Manifold<S>& result);

 private:
  Vec3d point(const Vec3<S>& in_a) const;
  Vec3d direction(const Vec3<S>& in_a) const;
  trace::Polygon polygon(const ClipPolygon<S>& in_a) const;

  ToWorld<S> to_world_;
  const char* reducer_name_;
  trace::Stages stages_;
  trace::Pair& pair_;
  double axis_separation_ = 0;
};

}  // namespace contactscope

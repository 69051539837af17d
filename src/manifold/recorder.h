#pragma once

#include "core/manifold.h"
#include "core/plane.h"
#include "core/preference.h"
#include "geometry/mesh.h"
#include "manifold/clip.h"
#include "manifold/collide_options.h"
#include "manifold/pair_cache.h"
#include "query/gjk.h"
#include "query/penetration.h"
#include "query/sat.h"
#include "reduce/reducer.h"

namespace contactscope {

/// The pipeline is a template on its recorder and calls these at the end of each stage. This one
/// records nothing: every call is empty and disappears, so that a pipeline that nobody watches is
/// the pipeline without a recorder. TraceRecorder is the other.
///
/// What is only worked out for the record stands behind `if constexpr (Recorder::kRecords)`.
template <class S>
struct NoRecorder {
  static constexpr bool kRecords = false;

  void axes(const HullPair<S>&, const SatResult<S>&, Preference) {}
  void cache(const CacheAnswer<S>&) {}
  void clip_begins(Owner, const ClipFace<S>&, const ClipFace<S>&) {}
  void clip_step(const Plane<S>&, const ClipPolygon<S>&) {}
  void dropped(const Vec3<S>&, const char*) {}
  void clip_abandoned() {}
  void contact_axis(AxisKind) {}
  void reduction(std::span<const ContactPoint<S>>, const Vec3<S>&, int, const KeptIndices&) {}
  /// Where a run of GJK that is to be told goes; nullptr: nowhere.
  GjkRun<S>* gjk_run() { return nullptr; }
  void gjk(const Pose<S>&) {}
  /// Where the steps of a penetration method that are to be told go; nullptr: nowhere.
  PenetrationSteps<S>* penetration_steps() { return nullptr; }
  void penetration(PenetrationMethod, const PenetrationResult<S>&, const char*) {}
  void minkowski(const Hull<S>&, const Hull<S>&, const Pose<S>&) {}
  void tree(const Mesh<S>&, const Aabb<S>&) {}
  void degenerate(const char*, Degenerate) {}
  void separation(S) {}
  void manifold(const Manifold<S>&) {}
};

}  // namespace contactscope

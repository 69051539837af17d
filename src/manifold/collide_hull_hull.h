#pragma once

#include "core/manifold.h"
#include "core/pose.h"
#include "core/preference.h"
#include "geometry/hull.h"
#include "reduce/reducer.h"
#include "trace/trace.h"

namespace contactscope {

template <class S>
struct CollideOptions {
  S margin = 0;  // metres; points up to this separation are kept
  Preference preference = Preference::Relative;
  Reducer<S> reducer = nullptr;  // nullptr keeps all points
  ReduceOptions reduction;
};

/// Gregorius 2015, "Hull vs Hull": separating axis test, then a face contact by clipping or an edge
/// contact by closest points, then reduction. Poses place the hulls in the world, where the
/// manifold is given. Empty when the hulls are apart by more than the margin; never empty when they
/// overlap.
template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions<S>& options);

/// The same, bit for bit, and writes what each stage decided into `record`: state, separation, sat,
/// clip, reduction, manifolds, kind. The names `record.a` and `record.b` are set by the caller and
/// are copied where a stage names a shape; `reducer_name` is what the reduction stage is called.
/// Of the optional stages those in `stages` are written.
template <class S>
Manifold<S> collide_hull_hull(const Hull<S>& a, const Pose<S>& pose_a, const Hull<S>& b,
                              const Pose<S>& pose_b, const CollideOptions<S>& options,
                              const char* reducer_name, const trace::Stages& stages,
                              trace::Pair& record);

}  // namespace contactscope

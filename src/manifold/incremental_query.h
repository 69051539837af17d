#pragma once

#include <optional>

#include "core/penetration_method.h"
#include "core/static_vector.h"
#include "manifold/collide_options.h"
#include "manifold/incremental_core.h"
#include "query/gjk.h"
#include "query/penetration.h"

namespace contactscope {

/// The closest (or, of overlapping cores, deepest) points of two cores, in A's frame, metres.
template <class S>
struct CoreContact {
  Vec3<S> on_a, on_b;
  CoreFeature feature_a, feature_b;  // the smallest that the points lie on
};

/// Most corners of the patch on which two cores are closest that are looked at.
inline constexpr std::size_t kMaxPatchPoints = 128;
template <class S>
using CorePatch = StaticVector<CoreContact<S>, kMaxPatchPoints>;

/// What is known of two cores in one frame. In A's frame.
template <class S>
struct CoreQuery {
  bool overlap = false;               // the cores meet: `method` measured how deep
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B
  S distance = 0;                     // metres, of the cores along it; negative in overlap
  AxisKind axis = AxisKind::ClosestPoints;
  CoreContact<S> closest;     // one of them
  S scale = 1;                // metres: no coordinate is larger
  PenetrationResult<S> deep;  // of cores that meet: what `method` found
};

/// Gregorius 2015, "Building Incremental Manifolds (1)": GJK on the cores; where they overlap or
/// touch, `method`. A half-space needs neither: its distance is exact at every depth, and it never
/// overlaps. `run` and `steps`: where to leave the run of GJK and what `method` did, or nullptr. Empty where nothing can be said, as
/// of coordinates that are not finite. `b` may be a half-space.
///
/// Where the normal is within rounding of a face's, it is that face's: GJK finds it from points that
/// are near each other and loses as many digits as they are nearer than the shapes are large.
template <class S>
std::optional<CoreQuery<S>> query_cores(const ShapeCore<S>& a, const ShapeCore<S>& b,
                                        const Pose<S>& b_in_a, PenetrationMethod method,
                                        GjkRun<S>* run, PenetrationSteps<S>* steps);

/// All places where the cores are as close as in `query`, within rounding: of parallel features the
/// corners of the patch that they share, seen along the normal; otherwise one. Each is named by the
/// two features whose meeting it is, so no two have the same. At least one; sorted by features.
template <class S>
CorePatch<S> closest_patch(const ShapeCore<S>& a, const ShapeCore<S>& b, const Pose<S>& b_in_a,
                           const CoreQuery<S>& query);

/// Where two features are nearest to each other now, in A's frame; empty where they do not face each
/// other: their nearest points lie beyond the border of one of them, or they share more than a
/// point. `scale` as in CoreQuery.
template <class S>
std::optional<CoreContact<S>> closest_on_features(const ShapeCore<S>& a, const CoreFeature& of_a,
                                                  const ShapeCore<S>& b, const CoreFeature& of_b,
                                                  const Pose<S>& b_in_a, S scale);

}  // namespace contactscope

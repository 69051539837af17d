#pragma once

#include <vector>

#include "manifold/incremental.h"
#include "manifold/incremental_query.h"

/// One frame of an incremental manifold in A's frame, before it is reduced. Inside of incremental.h.
namespace contactscope {

/// A point where it is in this frame: A's frame, metres.
template <class S>
struct StandingPoint {
  PersistentContact<S> kept;
  Vec3<S> on_a, on_b;
  S separation = 0;
  bool is_new = false;

  Vec3<S> position() const { return S(0.5) * (on_a + on_b); }
};

/// A point that is no longer in the manifold.
template <class S>
struct BrokenPoint {
  StandingPoint<S> point;
  const char* reason;  // "apart", "slid", "other features", "replaced", "reduced"
};

/// Room for what is kept and one new point.
template <class S>
struct IncrementalStep {
  StaticVector<StandingPoint<S>, kMaxPersistentPoints + 1> points;
  StaticVector<BrokenPoint<S>, kMaxPersistentPoints + 1> broken;
};

/// Step 2: what is left of `persistent`.
template <class S>
void confirm_points(const PersistentManifold<S>& persistent, const Pose<S>& b_in_a,
                    const CoreQuery<S>& query, const IncrementalSettings& settings, S margin,
                    IncrementalStep<S>& step);

/// Step 3: adds the newest point, or puts it in the place of an old one.
template <class S>
void add_point(const PersistentManifold<S>& persistent, const Pose<S>& b_in_a,
               const CoreQuery<S>& query, const IncrementalSettings& settings,
               IncrementalStep<S>& step);

}  // namespace contactscope

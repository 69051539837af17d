#pragma once

#include "manifold/incremental_step.h"
#include "manifold/to_world.h"
#include "trace/trace.h"

namespace contactscope {

/// What became of every point, for the trace: in the world, from A's frame. `mirrored`: told as if
/// the shapes had been given the other way round.
template <class S>
trace::Incremental told_step(const ToWorld<S>& to_world, const CoreQuery<S>& query,
                             const IncrementalStep<S>& step,
                             const PersistentManifold<S>& persistent,
                             const IncrementalOptions& options, bool mirrored);

}  // namespace contactscope

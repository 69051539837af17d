#pragma once

#include "trace/json.h"

namespace contactscope {

/// A half-metre crate whose lower face is 5 mm deep in a floor, turned about the up axis: frames 0
/// and 12, each with one pair, four contact points and every stage. All numbers are exact floats.
trace::Trace sample_trace();

/// The same contact as frame 12 of sample_trace(), for changes.
inline trace::Pair& sample_pair(trace::Trace& trace) { return trace.frames[1].pairs[0]; }
inline trace::Manifold& sample_manifold(trace::Trace& trace) {
  return sample_pair(trace).manifolds[0];
}

}  // namespace contactscope

#pragma once

#include "scenario/scenario.h"
#include "trace/trace.h"

namespace contactscope {

/// The trace's first line: shapes and settings. `scalar` is that of the first pair's settings.
trace::Header trace_header(const Scenario& scenario);

/// Poses and recorded pairs of one frame; frames are independent of each other.
trace::Frame run_frame(const Scenario& scenario, int frame);

/// The manifolds of one frame with nothing recorded but the manifolds themselves: the same pipeline
/// as run_frame, in the way a physics engine would call it. One entry a pair, `sat`, `clip` and
/// `reduction` empty.
trace::Frame run_frame_unrecorded(const Scenario& scenario, int frame);

}  // namespace contactscope

#pragma once

#include <optional>

#include "scenario/scenario.h"
#include "shrink/pair_of_two.h"
#include "trace/trace.h"

namespace contactscope::shrink {

/// A single pair of a frame: its shapes in the poses of the frame. `scenario`: source of the pair's
/// settings and expectations; null for a trace of another engine, whose claims are kept. Empty if
/// it cannot be written as a scenario of two shapes: a distance field, an unknown shape.
std::optional<PairOfTwo> pair_of_frame(const trace::Header& header, const trace::Frame& frame,
                                       const trace::Pair& pair, const Scenario* scenario);

}  // namespace contactscope::shrink

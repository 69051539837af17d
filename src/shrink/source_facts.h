#pragma once

#include <optional>
#include <string>

#include "scenario/scenario.h"
#include "shrink/pair_of_two.h"
#include "trace/trace.h"

namespace contactscope::shrink {

/// A pair of a frame by itself: its shapes in the poses of the frame. `scenario`: that the frame is of, whose
/// settings and expectations the pair has; null of a trace of another engine, whose claims it keeps. Empty
/// where it cannot be written as a scenario of two shapes: a distance field, a shape that is not told.
std::optional<PairOfTwo> pair_of_frame(const trace::Header& header, const trace::Frame& frame,
                                       const trace::Pair& pair, const Scenario* scenario);

}  // namespace contactscope::shrink

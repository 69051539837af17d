#pragma once

#include "trace/json.h"

namespace contactscope::trace {

/// A header and a frame in which every field of every stage has a value of its own, including
/// numbers that are hard to write: a float's 0.1, -0.0, 1e-300 and the largest double.
Header sample_header();
Frame sample_frame();

}  // namespace contactscope::trace

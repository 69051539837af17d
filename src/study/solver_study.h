#pragma once

#include "study/study.h"

namespace contactscope {

/// How stacks of boxes stand, by position method (Baumgarte, projection, soft), with and without warm
/// starting, against the static solution: every box at its height, every contact carrying what is
/// above it. Stacks and measures are those of solver_stack.h; three seconds, in float, 60 frames a
/// second. A stack that blows up (no numbers, energy from nowhere, a box fallen) counts as failed.
///
/// "penetration" (at the end), "worst" (in any frame), "drift", "jitter", "load" and "ids" against the
/// run time of a frame, over iterations without sub-steps and over sub-steps of one iteration each:
/// ten equal boxes. "penetration", "drift" and "jitter" likewise with "_heavy" for two boxes
/// under a third of a hundred times their mass, with "_two" and "_twenty" for so many equal boxes.
/// (Under ten thousand times their mass none of these settings keeps two boxes standing.)
///
/// "map", "drift_map", "jitter_map": stacks of 2 to 20 boxes, the highest of 1 to 10^6 times the
/// others' mass, at sixteen sweeps a frame for every method.
std::vector<trace::Study> study_solver(const StudyOptions& options, const StudyProgress& progress);

/// The same with another time, in frames (>= 1), in the place of three seconds.
std::vector<trace::Study> study_solver(const StudyOptions& options, const StudyProgress& progress,
                                       int frames);

}  // namespace contactscope

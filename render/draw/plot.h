#pragma once

#include "draw/drawing.h"
#include "trace/study.h"

namespace contactscope::draw {

/// Work-precision diagram of a study: error against run time, both axes logarithmic, a line a
/// method, a panel for the mean error and one for the worst where the study has it. Where the series
/// belong to panels, these are drawn instead, of the mean error, over the same ranges.
///
/// Lines run through the parameters in order, with the least and greatest time of a call as a thin
/// band, and are labelled at their ends. Methods that no other beats in both time and error are
/// strong, the others muted. Errors of zero, and those within the study's resolution, stand in a
/// row under the axis; failures are crosses in rows above it, with their count.
Drawing plot(const trace::Study& study, int width, int height);

}  // namespace contactscope::draw

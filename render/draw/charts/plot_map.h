#pragma once

#include "draw/scene/drawing.h"
#include "trace/study.h"

namespace contactscope::draw {

/// Panels of a study of form Map: a cell for every parameter (to the right, logarithmic) and row (up,
/// logarithmic, or a line each for rows that are names), in the colour of the decade of its largest
/// error, with a cross where cases failed. Darker is worse; a cell of failures alone is white.
Drawing plot_map(const trace::Study& study, int width, int height);

}  // namespace contactscope::draw

#pragma once

#include "draw/scene/drawing.h"
#include "trace/study.h"

namespace contactscope::draw {

/// Small multiples of a study of form Curves: in each panel the largest error of every series
/// against the parameter, both logarithmic. The error axis is the same in all panels. Series of the
/// same name look the same everywhere: solid and filled, or dashed and hollow where the name goes on
/// after a comma ("float, unrounded" beside "float"). The series that study.signal names is a grey
/// line: errors above it drown what is measured. Failures are crosses in rows at the top, with how
/// many of how many cases.
Drawing plot_curves(const trace::Study& study, int width, int height);

}  // namespace contactscope::draw

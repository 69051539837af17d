#pragma once

#include "draw/scene/drawing.h"
#include "trace/study.h"

namespace contactscope::draw {

/// A study in its form; plot_page.h has those of curves and maps.
///
/// Work precision: error against run time, both axes logarithmic, a line a method, a panel for the
/// mean error and one for the worst where the study has it, one above the other on a page that is
/// higher than wide. Where the series belong to panels, these are drawn instead, of the mean error,
/// over the same ranges.
///
/// Lines run through the parameters in order and are labelled at their ends. Methods that no other
/// beats in both time and error are strong, with the least and greatest time of a call as a thin
/// band; the others are muted, and bands of many would hide each other. Errors of zero, and those
/// within the study's resolution, stand in a row under the axis; failures are crosses in rows above
/// it, with their count.
Drawing plot(const trace::Study& study, int width, int height);

}  // namespace contactscope::draw

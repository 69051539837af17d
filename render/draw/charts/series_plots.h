#pragma once

#include "draw/charts/time_series.h"

namespace contactscope::draw {

/// The content of panel "plots": charts over each other, one time axis under them, and the strip of
/// contact ids. Of two to four pairs each has lines of its own. `duration`: seconds from the first
/// frame to the last; `pixel`: one at 720 lines; `step`: seconds of a frame, where impulses are to be
/// shown as the forces that they are over this time, else 0. Where there is little room, the strip,
/// then the last charts are left out; returns how many.
std::size_t draw_series_plots(const std::vector<TimeSeries>& series, std::size_t moment,
                              double duration, const Rect& rect, float pixel, Drawing& drawing,
                              double step = 0);

}  // namespace contactscope::draw

#pragma once

#include "draw/time_series.h"

namespace contactscope::draw {

/// The content of panel "plots": charts over each other, one time axis under them, and the strip of
/// contact ids. `dt`: seconds from the first frame to the last; `pixel`: one at 720 lines. Where
/// there is little room, the strip, then the last charts are left out.
void draw_series_plots(const std::vector<TimeSeries>& series, std::size_t moment, double duration,
                       const Rect& rect, float pixel, Drawing& drawing);

}  // namespace contactscope::draw

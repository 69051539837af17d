#pragma once

#include "draw/camera.h"
#include "draw/drawing.h"
#include "draw/method_style.h"
#include "trace/study.h"

namespace contactscope::draw {

/// One diagram of plot(), in `rect`: heading, axes and all that lies between them. `scale` is that
/// of text and lines.
void draw_plot_panel(const trace::Study& study, ErrorKind kind, const Rect& rect, float scale,
                     Drawing& drawing);

}  // namespace contactscope::draw

#pragma once

#include <string>

#include "draw/charts/method_style.h"
#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
#include "trace/study.h"

namespace contactscope::draw {

/// One diagram of plot(), in `rect`: heading, axes and all that lies between them. `scale` is that
/// of text and lines. Where series have a panel, those of `panel` are drawn alone, under its name.
void draw_plot_panel(const trace::Study& study, ErrorKind kind, const Rect& rect, float scale,
                     Drawing& drawing, const std::string& panel = {});

}  // namespace contactscope::draw

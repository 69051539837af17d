#pragma once

#include "draw/scene/drawing.h"
#include "draw/staging.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// One frame as the view shows it, made from the trace alone; nothing of the pipeline is computed
/// again. The same frame gives the same drawing.
Drawing illustrate(const Staging& staging, const trace::Frame& frame);

/// The part before pixels: what the view's layers add for this frame, in the world.
Sketch sketch_frame(const Staging& staging, const trace::Frame& frame);

/// What the frame is to the layers of a staged view.
Scene scene_of(const Staging& staging, const trace::Frame& frame);

/// The legend of the whole picture, without drawing it. What layers, insets and panels show alike is
/// explained once.
std::vector<LegendEntry> legend_of(const Staging& staging, const trace::Frame& frame);

}  // namespace contactscope::draw

#pragma once

#include "draw/insets/contact_plane.h"
#include "draw/layers/layer.h"
#include "draw/staging.h"

/// The legend of a whole picture, which is known before the picture is drawn.
namespace contactscope::draw {

/// What the frame is to the layers of a staged view.
Scene scene_of(const Staging& staging, const trace::Frame& frame);

/// Those of the view, in drawing order.
std::vector<const LayerDrawing*> shown_layers(const Staging& staging);

/// False as long as a story of clipping has not come to the contacts of the pair.
bool is_told(const Scene& scene, const trace::Pair& pair);

/// What the layers of the view have to explain.
Legend layers_legend(const Staging& staging, const Scene& scene);

/// And what the insets and panels have to: what they show alike is explained once.
std::vector<LegendEntry> legend_of(const Staging& staging, const trace::Frame& frame);

}  // namespace contactscope::draw

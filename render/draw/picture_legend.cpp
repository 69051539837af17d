#include "draw/picture_legend.h"

namespace contactscope::draw {

Scene scene_of(const Staging& staging, const trace::Frame& frame) {
  return {staging.view,   *staging.header,      frame,         staging.meshes,
          staging.camera, staging.depth_factor, staging.scales};
}

std::vector<const LayerDrawing*> shown_layers(const Staging& staging) {
  std::vector<const LayerDrawing*> layers;
  for (std::size_t i = 0; i < staging.layers->size(); ++i) {
    if (staging.view.shows(static_cast<Layer>(i))) layers.push_back((*staging.layers)[i]);
  }
  return layers;
}

bool is_told(const Scene& scene, const trace::Pair& pair) {
  return scene.view.story != Story::ClipSteps || !pair.clip ||
         scene.frame.frame > static_cast<int>(pair.clip->steps.size());
}

Legend layers_legend(const Staging& staging, const Scene& scene) {
  const std::vector<const LayerDrawing*> layers = shown_layers(staging);
  Legend legend;
  const auto explain_frame = [&](bool above) {
    for (const LayerDrawing* layer : layers) {
      if (layer->explain_frame != nullptr && (layer->above != nullptr) == above)
        layer->explain_frame(scene, legend);
    }
  };
  explain_frame(false);
  for (const trace::Pair& pair : scene.frame.pairs) {
    const bool told = is_told(scene, pair);
    for (const LayerDrawing* layer : layers) {
      if (layer->explain != nullptr && (told || layer->result == nullptr))
        layer->explain(scene, pair, legend);
    }
  }
  explain_frame(true);
  return legend;
}

std::vector<LegendEntry> legend_of(const Staging& staging, const trace::Frame& frame) {
  const Scene scene = scene_of(staging, frame);
  Legend legend = layers_legend(staging, scene);
  for (const Inset& inset : staging.insets)
    legend.explain(sketch_inset(inset, scene).sketch.legend);
  explain_panels(staging.view, frame, legend);
  return legend.sorted();
}

}  // namespace contactscope::draw

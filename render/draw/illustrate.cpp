#include "draw/illustrate.h"

#include "core/at.h"
#include "draw/insets/contact_plane.h"
#include "draw/pair_label.h"
#include "draw/scene/compose.h"
#include "draw/scene/pair_points.h"
#include "draw/scene/points.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

std::string moment(const trace::Frame& frame) {
  return printed("frame %d, t = %.3f s", frame.frame, frame.time);
}

// Labels stand away from the middle of what touches.
Vec3d center_of_contact(const Scene& scene) {
  std::vector<Vec3d> points;
  for (const trace::Pair& pair : scene.frame.pairs) {
    for (const PairPoint& any : all_points(pair)) points.push_back(any.point->position);
  }
  if (!points.empty()) return mean_of(points);
  for (const PlacedShape& shape : scene.shapes) {
    if (!shape.mesh->shape->half_space)
      points.push_back(shape.pose.transform(shape.mesh->shape->center_of_mass));
  }
  return points.empty() ? Vec3d(Vec3d::Zero()) : mean_of(points);
}

// Those of the view, in drawing order.
std::vector<const LayerDrawing*> shown_layers(const Staging& staging) {
  std::vector<const LayerDrawing*> layers;
  for (std::size_t i = 0; i < staging.layers->size(); ++i) {
    if (staging.view.shows(static_cast<Layer>(i))) layers.push_back((*staging.layers)[i]);
  }
  return layers;
}

// False as long as a story of clipping has not come to the contacts of the pair.
bool is_told(const Scene& scene, const trace::Pair& pair) {
  return scene.view.story != Story::ClipSteps || !pair.clip ||
         scene.frame.frame > count_of(pair.clip->steps);
}

// What the view's layers add; or for the legend alone, without those that explain apart.
Sketch sketched(const Staging& staging, const Scene& scene, bool legend_alone) {
  Sketch sketch;
  std::vector<const LayerDrawing*> layers = shown_layers(staging);
  for (const LayerDrawing* layer : layers) {
    if (layer->explain != nullptr) layer->explain(scene, sketch.legend);
  }
  if (legend_alone)
    std::erase_if(layers, [](const LayerDrawing* layer) { return layer->explain != nullptr; });
  else
    sketch.center = center_of_contact(scene);
  const auto draw = [&](auto LayerDrawing::*part, const auto&... what) {
    for (const LayerDrawing* layer : layers) {
      if (layer->*part != nullptr) (layer->*part)(scene, what..., sketch);
    }
  };
  draw(&LayerDrawing::beneath);
  for (const trace::Pair& pair : scene.frame.pairs) {
    draw(&LayerDrawing::search, pair);
    if (!legend_alone) draw_pair_label(scene, pair, sketch);
    if (is_told(scene, pair)) draw(&LayerDrawing::result, pair);
  }
  draw(&LayerDrawing::above);
  return sketch;
}

}  // namespace

Scene scene_of(const Staging& staging, const trace::Frame& frame) {
  return {staging.view,   *staging.header,      frame,         staging.meshes,
          staging.camera, staging.depth_factor, staging.scales};
}

std::vector<LegendEntry> legend_of(const Staging& staging, const trace::Frame& frame) {
  const Scene scene = scene_of(staging, frame);
  Legend legend = sketched(staging, scene, true).legend;
  for (const Inset& inset : staging.insets)
    legend.explain(sketch_inset(inset, scene).sketch.legend);
  explain_panels(staging.view, frame, legend);
  return legend.sorted();
}

Sketch sketch_frame(const Staging& staging, const trace::Frame& frame) {
  return sketched(staging, scene_of(staging, frame), false);
}

Drawing illustrate(const Staging& staging, const trace::Frame& frame) {
  if (staging.cells) return staging.cells->frame(frame.frame);
  Drawing drawing{.width = staging.layout.width, .height = staging.layout.height};
  const Scene scene = scene_of(staging, frame);
  const Sketch sketch = sketched(staging, scene, false);
  compose(sketch, staging.camera, staging.layout, drawing);
  Legend legend = sketch.legend;
  for (const Inset& inset : staging.insets) {
    const InsetPicture picture = sketch_inset(inset, scene);
    legend.explain(picture.sketch.legend);
    draw_inset(inset, picture, staging.layout, drawing);
  }
  explain_panels(staging.view, frame, legend);
  draw_legend(legend.sorted(), staging.layout, drawing);
  draw_captions(staging.header->title, staging.header->source, moment(frame), staging.layout,
                drawing);
  return drawing;
}

}  // namespace contactscope::draw

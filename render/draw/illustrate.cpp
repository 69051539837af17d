#include "draw/illustrate.h"

#include "draw/pair_label.h"
#include "draw/picture_legend.h"
#include "draw/scene/compose.h"
#include "draw/scene/pair_points.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

std::string moment(const trace::Frame& frame) {
  return printed("frame %d, t = %.3f s", frame.frame, frame.time);
}

// Labels stand away from the middle of what touches.
Vec3d center_of_contact(const Scene& scene) {
  Vec3d sum = Vec3d::Zero();
  std::size_t count = 0;
  for (const trace::Pair& pair : scene.frame.pairs) {
    for (const PairPoint& any : all_points(pair)) {
      sum += any.point->position;
      ++count;
    }
  }
  if (count > 0) return sum / static_cast<double>(count);
  for (const PlacedShape& shape : scene.shapes) {
    if (shape.mesh->shape->half_space) continue;
    sum += shape.pose.transform(shape.mesh->shape->center_of_mass);
    ++count;
  }
  return count > 0 ? Vec3d(sum / static_cast<double>(count)) : sum;
}

Sketch sketched(const Staging& staging, const Scene& scene) {
  Sketch sketch;
  sketch.center = center_of_contact(scene);
  const std::vector<const LayerDrawing*> layers = shown_layers(staging);
  const auto draw_frame = [&](LayerDrawing::OfFrame LayerDrawing::*part) {
    for (const LayerDrawing* layer : layers) {
      if (layer->*part != nullptr) (layer->*part)(scene, sketch);
    }
  };
  const auto draw_pair = [&](LayerDrawing::OfPair LayerDrawing::*part, const trace::Pair& pair) {
    for (const LayerDrawing* layer : layers) {
      if (layer->*part != nullptr) (layer->*part)(scene, pair, sketch);
    }
  };
  draw_frame(&LayerDrawing::beneath);
  for (const trace::Pair& pair : scene.frame.pairs) {
    draw_pair(&LayerDrawing::search, pair);
    draw_pair_label(scene, pair, sketch);
    if (is_told(scene, pair)) draw_pair(&LayerDrawing::result, pair);
  }
  draw_frame(&LayerDrawing::above);
  sketch.legend = layers_legend(staging, scene);
  return sketch;
}

}  // namespace

Sketch sketch_frame(const Staging& staging, const trace::Frame& frame) {
  return sketched(staging, scene_of(staging, frame));
}

Drawing illustrate(const Staging& staging, const trace::Frame& frame) {
  if (staging.cells) return staging.cells->frame(frame.frame);
  Drawing drawing;
  drawing.width = staging.layout.width;
  drawing.height = staging.layout.height;
  const Scene scene = scene_of(staging, frame);
  const Sketch sketch = sketched(staging, scene);
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

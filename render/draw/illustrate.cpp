#include "core/at.h"
#include "draw/insets/contact_plane.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/quantity.h"
#include "draw/staging.h"

namespace contactscope::draw {
namespace {

using Needs = std::array<bool Stages::*, 3>;

Needs needs_of(Panel panel) {
  switch (panel) {
    case Panel::Summary:
      return {&Stages::sat, &Stages::reduction, &Stages::query};
    case Panel::AxisIntervals:
    case Panel::Answers:
      return {&Stages::query};
    case Panel::ContactPlane:
      return {&Stages::clip, &Stages::reduction};
    case Panel::AxisHistory:
      return {&Stages::sat};
    case Panel::Stability:
      return {&Stages::stability};
    case Panel::Approach:
    case Panel::Plots:
    case Panel::Pipeline:
      return {};
    case Panel::TreeCost:
      return {&Stages::query};
    case Panel::Endpoints:
      return {&Stages::cells};
    case Panel::NodePairs:
      return {&Stages::query, &Stages::node_pairs};
    case Panel::Minkowski:
      return {&Stages::minkowski, &Stages::gjk, &Stages::penetration};
    case Panel::GaussMap:
      return {&Stages::gauss_map, &Stages::sat};
  }
  return {};
}

Needs needs_of(Story story) {
  switch (story) {
    case Story::None:
      return {};
    case Story::ClipSteps:
      return {&Stages::clip};
    case Story::GjkSteps:
    case Story::EpaSteps:
      return {&Stages::gjk, &Stages::penetration};
  }
  return {};
}

// Labels stand away from the middle of what touches.
Vec3d center_of_contact(const Scene& scene) {
  std::vector<Vec3d> points;
  for (const trace::Pair& pair : scene.frame.pairs) append(points, positions_of(pair));
  if (!points.empty()) return mean_of(points);
  for (const PlacedShape& shape : scene.shapes) {
    if (!shape.traced().half_space)
      points.push_back(shape.pose.transform(shape.traced().center_of_mass));
  }
  return points.empty() ? Vec3d(Vec3d::Zero()) : mean_of(points);
}

// What the view's layers add; or for the legend alone, without those that explain apart.
Sketch sketched(const Staging& staging, const Scene& scene, bool legend_alone) {
  Sketch sketch;
  if (!legend_alone) sketch.center = center_of_contact(scene);
  std::vector<std::pair<Layer, const LayerDrawing*>> layers;  // in drawing order
  for (std::size_t i = 0; i < staging.layers->size(); ++i) {
    if (!staging.view.shows(static_cast<Layer>(i))) continue;
    const LayerDrawing* layer = (*staging.layers)[i];
    if (layer->explain != nullptr) layer->explain(scene, sketch.legend);
    if (!legend_alone || layer->explain == nullptr)
      layers.emplace_back(static_cast<Layer>(i), layer);
  }
  std::string pair_name;  // of what is drawn now
  const auto draw = [&](auto LayerDrawing::*part, const auto&... what) {
    for (const auto& [layer, drawn] : layers) {
      if (drawn->*part == nullptr) continue;
      if (!legend_alone) sketch.begin(name_of(layer), pair_name);
      (drawn->*part)(scene, what..., sketch);
    }
  };
  draw(&LayerDrawing::beneath);
  for (const trace::Pair& pair : scene.frame.pairs) {
    pair_name = pair.a + " " + pair.b;
    draw(&LayerDrawing::search, pair);
    if (!legend_alone) {
      sketch.begin(kPairLabelPart, pair_name);
      draw_pair_label(scene, pair, sketch);
    }
    // A story of clipping comes last to the contacts of the pair.
    if (scene.view.story != Story::ClipSteps || !pair.clip ||
        scene.frame.frame > count_of(pair.clip->steps))
      draw(&LayerDrawing::result, pair);
  }
  pair_name.clear();
  draw(&LayerDrawing::above);
  return sketch;
}

}  // namespace

Scene scene_of(const Staging& staging, const trace::Frame& frame) {
  return {staging.view,   *staging.header,       frame, staging.meshes, staging.camera,
          staging.scales, staging.sequence.get()};
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
  drawing.words = staging.layout.words;
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
  if (staging.style.legend) draw_legend(legend.sorted(), staging.layout, drawing);
  draw_captions(staging.header->title, staging.header->source, staging.moments.of(frame),
                staging.layout, drawing);
  return drawing;
}

Stages stages_shown(const std::vector<View>& views) {
  Stages stages = Stages::none();
  const auto add = [&](const Needs& needs) {
    for (const auto stage : needs) {
      if (stage != nullptr) stages.*stage = true;
    }
  };
  for (const View& view : views) {
    for (const Layer layer : view.layers) add(kLayers[static_cast<std::size_t>(layer)]->needs);
    for (const Panel panel : view.panels) add(needs_of(panel));
    add(needs_of(view.story));
    stages.reduction = stages.reduction || view.kind == ViewKind::ContactPlane;
  }
  return stages;
}

}  // namespace contactscope::draw

#include "draw/illustrate.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "draw/insets/panel_legend.h"
#include "draw/scene/compose.h"
#include "draw/scene/mesh_surface.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

std::string moment(const trace::Frame& frame) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "frame %d, t = %.3f s", frame.frame, frame.time);
  return text.data();
}

// Labels stand away from the middle of what touches.
Vec3d center_of_contact(const trace::Frame& frame, const std::vector<PlacedShape>& shapes) {
  Vec3d sum = Vec3d::Zero();
  int count = 0;
  for (const trace::Pair& pair : frame.pairs) {
    for (const trace::Manifold& manifold : pair.manifolds) {
      for (const trace::Point& point : manifold.points) {
        sum += point.position;
        ++count;
      }
    }
  }
  if (count > 0) return sum / count;
  for (const PlacedShape& shape : shapes) {
    if (shape.mesh->shape->half_space) continue;
    sum += shape.pose.transform(shape.mesh->shape->center_of_mass);
    ++count;
  }
  return count > 0 ? Vec3d(sum / count) : sum;
}

Scene scene_of(const Staging& staging, const trace::Frame& frame) {
  return {staging.view,   *staging.header,      frame,         place_shapes(staging.meshes, frame),
          staging.camera, staging.depth_factor, staging.scales};
}

std::vector<InsetPicture> inset_pictures(const Staging& staging, const trace::Frame& frame) {
  std::vector<InsetPicture> pictures;
  if (staging.insets.empty()) return pictures;
  const Scene scene = scene_of(staging, frame);
  for (const Inset& inset : staging.insets) pictures.push_back(sketch_inset(inset, scene));
  return pictures;
}

void sort_legend(Sketch& sketch) {
  // A measure too narrow for its arrow means the same as one that is not.
  const std::vector<LegendEntry> all = sketch.legend;
  std::erase_if(sketch.legend, [&](const LegendEntry& entry) {
    return entry.kind == LegendKind::NarrowAxis &&
           std::any_of(all.begin(), all.end(), [&](const LegendEntry& other) {
             return other.kind == LegendKind::Axis && other.text == entry.text;
           });
  });
  std::stable_sort(sketch.legend.begin(), sketch.legend.end(),
                   [](const LegendEntry& a, const LegendEntry& b) { return a.kind < b.kind; });
}

// What shapes, insets and panels show alike is explained once.
std::vector<LegendEntry> merged_legend(const Staging& staging, const trace::Frame& frame,
                                       Sketch sketch, const std::vector<InsetPicture>& insets) {
  for (const InsetPicture& inset : insets) {
    for (const LegendEntry& entry : inset.sketch.legend) sketch.explain(entry.kind, entry.text);
  }
  explain_panels(staging, frame, sketch);
  sort_legend(sketch);
  return sketch.legend;
}

// Of several pairs that share a name the last one bears it: of a stack the uppermost. What is out of
// the picture is not named in it.
bool bears_name(const Scene& scene, const trace::Pair& pair) {
  const auto is_seen = [&](const std::string& name) {
    const PlacedShape* shape = scene.find(name);
    return shape != nullptr && in_view(scene.camera, *shape);
  };
  if (!is_seen(pair.a) && !is_seen(pair.b)) return false;
  const trace::Frame& frame = scene.frame;
  return std::none_of(&pair + 1, frame.pairs.data() + frame.pairs.size(),
                      [&](const trace::Pair& later) { return later.label == pair.label; });
}

}  // namespace

std::vector<LegendEntry> legend_of(const Staging& staging, const trace::Frame& frame) {
  return merged_legend(staging, frame, sketch_frame(staging, frame),
                       inset_pictures(staging, frame));
}

Sketch sketch_frame(const Staging& staging, const trace::Frame& frame) {
  const Scene scene = scene_of(staging, frame);
  Sketch sketch;
  sketch.center = center_of_contact(frame, scene.shapes);
  if (scene.shows(Layer::Shapes)) draw_shapes(scene, sketch);
  draw_touched_triangles(scene, sketch);
  if (scene.shows(Layer::CenterOfMass)) draw_centers_of_mass(scene, sketch);
  for (const trace::Pair& pair : frame.pairs) {
    draw_reference_face(scene, pair, sketch);
    draw_clipping(scene, pair, sketch);
    draw_incident_face(scene, pair, sketch);  // its dashes leave an equal clip polygon visible
    if (scene.shows(Layer::Tree)) draw_tree(scene, pair, sketch);
    if (scene.shows(Layer::SatAxes)) draw_sat_axes(scene, pair, true, sketch);
    if (scene.shows(Layer::ContactAxis)) {
      draw_sat_axes(scene, pair, false, sketch);
      draw_deciding_edges(scene, pair, sketch);
    }
    if (scene.shows(Layer::Core)) draw_cores(scene, pair, sketch);
    if (scene.shows(Layer::Simplex)) draw_simplex_points(scene, pair, sketch);
    if (scene.shows(Layer::Support)) draw_support(scene, pair, sketch);
    if (staging.view.shows(Panel::Stability)) explain_stability_panel(pair, sketch);
    if (!pair.label.empty() && bears_name(scene, pair)) draw_pair_label(scene, pair, sketch);
    const bool told = staging.view.story != Story::ClipSteps || !pair.clip ||
                      frame.frame > static_cast<int>(pair.clip->steps.size());
    if (!told) continue;  // the story has not come to the contacts yet
    if (scene.shows(Layer::Coherent)) draw_coherent_points(pair, sketch);
    draw_contacts(scene, pair, sketch);
    if (scene.shows(Layer::Ids)) draw_edge_names(scene, pair, sketch);
    const bool measured = scene.shows(Layer::SatAxes) || scene.shows(Layer::ContactAxis) ||
                          scene.shows(Layer::Simplex);
    if (scene.shows(Layer::Contacts) && !measured) draw_gap(scene, pair, sketch);
    if (scene.shows(Layer::Persistent)) draw_persistent_points(scene, pair, sketch);
    if (scene.shows(Layer::Impulses)) draw_impulses(scene, pair, sketch);
    if (scene.shows(Layer::Overlap)) draw_overlap(scene, pair, sketch);
    if (scene.shows(Layer::RelativeVelocity)) draw_relative_velocity(scene, pair, sketch);
  }
  if (scene.shows(Layer::Ahead)) draw_ahead(scene, sketch);
  if (scene.shows(Layer::Velocities)) draw_velocities(scene, sketch);
  if (scene.shows(Layer::Masses)) draw_masses(scene, sketch);
  sort_legend(sketch);
  return sketch;
}

Drawing illustrate(const Staging& staging, const trace::Frame& frame) {
  if (staging.cells) return staging.cells->frame(frame.frame);
  Drawing drawing;
  drawing.width = staging.layout.width;
  drawing.height = staging.layout.height;
  const Sketch sketch = sketch_frame(staging, frame);
  compose(sketch, staging.camera, staging.layout, drawing);
  const std::vector<InsetPicture> insets = inset_pictures(staging, frame);
  for (std::size_t i = 0; i < insets.size(); ++i)
    draw_inset(staging.insets[i], insets[i], staging.layout, drawing);
  draw_legend(merged_legend(staging, frame, sketch, insets), staging.layout, drawing);
  draw_captions(staging.header->title, staging.header->source, moment(frame), staging.layout,
                drawing);
  return drawing;
}

}  // namespace contactscope::draw

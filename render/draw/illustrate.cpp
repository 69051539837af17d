#include "draw/illustrate.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "draw/compose.h"
#include "draw/mesh_surface.h"
#include "draw/scene.h"

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

}  // namespace

Sketch sketch_frame(const Staging& staging, const trace::Frame& frame) {
  const Scene scene{staging.view,   *staging.header,     frame, place_shapes(staging.meshes, frame),
                    staging.camera, staging.depth_factor};
  Sketch sketch;
  sketch.center = center_of_contact(frame, scene.shapes);
  if (scene.shows("shapes")) draw_shapes(scene, sketch);
  draw_touched_triangles(scene, sketch);
  for (const trace::Pair& pair : frame.pairs) {
    draw_reference_face(scene, pair, sketch);
    draw_clipping(scene, pair, sketch);
    draw_incident_face(scene, pair, sketch);  // its dashes leave an equal clip polygon visible
    if (scene.shows("tree")) draw_tree(scene, pair, sketch);
    if (scene.shows("sat_axes")) draw_sat_axes(scene, pair, true, sketch);
    if (scene.shows("contact_axis")) draw_sat_axes(scene, pair, false, sketch);
    if (!pair.label.empty()) draw_pair_label(scene, pair, sketch);
    const bool told = staging.view.story != Story::ClipSteps || !pair.clip ||
                      frame.frame > static_cast<int>(pair.clip->steps.size());
    if (!told) continue;  // the story has not come to the contacts yet
    if (scene.shows("coherent")) draw_coherent_points(pair, sketch);
    draw_contacts(scene, pair, sketch);
  }
  std::stable_sort(sketch.legend.begin(), sketch.legend.end(),
                   [](const LegendEntry& a, const LegendEntry& b) { return a.kind < b.kind; });
  return sketch;
}

Drawing illustrate(const Staging& staging, const trace::Frame& frame) {
  if (staging.cells) return staging.cells->frame(frame.frame);
  Drawing drawing;
  drawing.width = staging.layout.width;
  drawing.height = staging.layout.height;
  const Sketch sketch = sketch_frame(staging, frame);
  compose(sketch, staging.camera, staging.layout, drawing);
  draw_legend(sketch.legend, staging.layout, drawing);
  draw_captions(staging.header->title, staging.header->source, moment(frame), staging.layout,
                drawing);
  return drawing;
}

}  // namespace contactscope::draw

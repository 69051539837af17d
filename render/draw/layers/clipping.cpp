#include <algorithm>

#include "draw/scene/palette.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

// Height of a drawn side plane, as a fraction of the reference face's size.
constexpr double kPlaneHeight = 0.22;

std::size_t steps_to_show(const Scene& scene, const trace::Clip& clip) {
  if (scene.view.story != Story::ClipSteps) return clip.steps.size();
  return std::min(clip.steps.size(), static_cast<std::size_t>(scene.frame.frame));
}

void draw_side_plane(const trace::Clip& clip, std::size_t step, bool is_new, Sketch& sketch) {
  const trace::Polygon& face = clip.reference.polygon;
  const Vec3d& from = face[step];
  const Vec3d& to = face[(step + 1) % face.size()];
  double size = 0;
  for (const Vec3d& p : face) size = std::max(size, (p - face[0]).norm());
  const Vec3d rise = 0.5 * kPlaneHeight * size * clip.reference.normal;
  const std::vector<Vec3d> quad = {from - rise, to - rise, to + rise, from + rise};
  sketch.surfaces.push_back({quad, with_alpha(kSidePlane, is_new ? 0.36f : 0.12f)});
  sketch.outline(quad, {is_new ? 1.5f : 1.0f, with_alpha(kSidePlane, is_new ? 1.0f : 0.6f)});
  Arrow outward;
  outward.from = 0.5 * (from + to);
  outward.direction = clip.steps[step].normal;
  outward.pixels = 30;
  outward.width = 1.5f;
  outward.head = 8;
  outward.color = with_alpha(kSidePlane, is_new ? 1.0f : 0.6f);
  outward.halo = false;
  sketch.arrows.push_back(outward);
  sketch.explain(LegendKind::SidePlane, "side plane, outward normal");
}

}  // namespace

bool is_kept(const trace::Pair& pair, const trace::DroppedPoint& dropped) {
  const Vec3d& normal = pair.clip->reference.normal;
  const trace::Polygon& face = pair.clip->incident.polygon;
  double size = 0;
  for (const Vec3d& p : face) size = std::max(size, (p - face.front()).norm());
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) {
      const Vec3d way = dropped.position - point.position;
      if ((way - way.dot(normal) * normal).norm() < 1e-5 * size) return true;
    }
  }
  return false;
}

// Gregorius 2015, "Hull vs Hull: Face Contact Clipping": Sutherland-Hodgman, one side plane after
// the other. The polygon of the last shown step is at full strength, earlier ones fade.
void draw_clipping(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.clip) return;
  const trace::Clip& clip = *pair.clip;
  const std::size_t shown = steps_to_show(scene, clip);
  const bool story = scene.view.story == Story::ClipSteps;

  if (scene.shows(Layer::SidePlanes)) {
    for (std::size_t k = 0; k < shown; ++k) {
      draw_side_plane(clip, k, !story || k + 1 == shown, sketch);
    }
  }
  if (scene.shows(Layer::ClipPolygons)) {
    for (std::size_t k = 0; k < shown; ++k) {
      const trace::Polygon& polygon = clip.steps[k].polygon;
      if (polygon.empty()) continue;
      const bool last = k + 1 == shown;
      if (last) sketch.explain(LegendKind::ClipPolygon, "clip polygon");
      if (last) sketch.surfaces.push_back({polygon, with_alpha(kClipPolygon, 0.22f)});
      sketch.outline(polygon, {2.5f, with_alpha(kClipPolygon, last ? 1.0f : 0.22f)});
    }
  }
  if (scene.shows(Layer::Dropped) && shown == clip.steps.size()) {
    for (const trace::DroppedPoint& point : clip.dropped) {
      if (is_kept(pair, point)) continue;
      sketch.marks.push_back({MarkKind::Cross, point.position, kDropped});
      sketch.explain(LegendKind::Dropped, point.reason);
    }
  }
}

}  // namespace contactscope::draw

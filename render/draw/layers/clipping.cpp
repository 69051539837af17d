#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// Gregorius 2015, "Hull vs Hull: Face Contact Clipping": Sutherland-Hodgman, one side plane after
/// the other. The polygon of the last shown step is at full strength, earlier ones fade.
namespace contactscope::draw {
namespace {

// Height of a drawn side plane, as a fraction of the reference face's size.
constexpr double kPlaneHeight = 0.22;

constexpr Swatch kSidePlaneSwatch{LegendGroup::Faces, 1,
                                  [](auto& pen) { pen.area(kSidePlane, 0.2f, 1.2); }};

// Gregorius 2015, "Hull vs Hull: Face Contact".
template <bool kReference>
void draw_clip_face(const Scene&, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.clip) return;
  const trace::Polygon& polygon = (kReference ? pair.clip->reference : pair.clip->incident).polygon;
  const Color color = kReference ? kReferenceFace : kIncidentFace;
  sketch.face(polygon, with_alpha(color, 0.35f), {3.0f, color, !kReference});
  sketch.explain(kReference ? kReferenceFaceSwatch : kIncidentFaceSwatch,
                 kReference ? "reference face" : "incident face");
}

std::size_t steps_to_show(const Scene& scene, const trace::Pair& pair) {
  if (!pair.clip) return 0;
  if (scene.view.story != Story::ClipSteps) return pair.clip->steps.size();
  return std::min(pair.clip->steps.size(), static_cast<std::size_t>(scene.frame.frame));
}

void draw_side_plane(const trace::Clip& clip, std::size_t step, bool is_new, Sketch& sketch) {
  const trace::Polygon& face = clip.reference.polygon;
  const Vec3d& from = face[step];
  const Vec3d& to = face[(step + 1) % face.size()];
  const Vec3d rise = 0.5 * kPlaneHeight * reach_of(face) * clip.reference.normal;
  const Color border = with_alpha(kSidePlane, is_new ? 1.0f : 0.6f);
  sketch.face({from - rise, to - rise, to + rise, from + rise},
              with_alpha(kSidePlane, is_new ? 0.36f : 0.12f), {is_new ? 1.5f : 1.0f, border});
  sketch.arrows.push_back({.from = 0.5 * (from + to),
                           .direction = clip.steps[step].normal,
                           .pixels = 30,
                           .width = 1.5f,
                           .head = 8,
                           .color = border,
                           .halo = false});
}

void draw_side_planes(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::size_t shown = steps_to_show(scene, pair);
  const bool story = scene.view.story == Story::ClipSteps;
  for (std::size_t k = 0; k < shown; ++k)
    draw_side_plane(*pair.clip, k, !story || k + 1 == shown, sketch);
  if (shown > 0) sketch.explain(kSidePlaneSwatch, "side plane, outward normal");
}

void draw_clip_polygons(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::size_t shown = steps_to_show(scene, pair);
  for (std::size_t k = 0; k < shown; ++k) {
    const trace::Polygon& polygon = pair.clip->steps[k].polygon;
    const bool last = k + 1 == shown;
    if (polygon.empty()) continue;
    sketch.outline(polygon, {2.5f, with_alpha(kClipPolygon, last ? 1.0f : 0.22f)});
    if (!last) continue;
    sketch.surfaces.push_back({polygon, with_alpha(kClipPolygon, 0.22f)});
    sketch.explain(kClipPolygonSwatch, "clip polygon");
  }
}

/// Points that the clipping took away for good, once all of its steps are shown.
void draw_dropped(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.clip || steps_to_show(scene, pair) < pair.clip->steps.size()) return;
  for (const trace::DroppedPoint& point : pair.clip->dropped) {
    if (is_kept(pair, point)) continue;
    sketch.mark(MarkKind::Cross, point.position, kDropped);
    sketch.explain(kDroppedSwatch, point.reason);
  }
}

}  // namespace

const LayerDrawing kReferenceFaceLayer{
    .needs = {&Stages::clip}, .beneath = draw_touched_triangles, .search = draw_clip_face<true>};
const LayerDrawing kIncidentFaceLayer{.needs = {&Stages::clip}, .search = draw_clip_face<false>};
const LayerDrawing kSidePlanesLayer{.needs = {&Stages::clip}, .search = draw_side_planes};
const LayerDrawing kClipPolygonsLayer{.needs = {&Stages::clip}, .search = draw_clip_polygons};
const LayerDrawing kDroppedLayer{.needs = {&Stages::clip}, .search = draw_dropped};

}  // namespace contactscope::draw

#include "draw/layers/layer.h"
#include "draw/scene/clip_story.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// Gregorius 2015, "Hull vs Hull: Face Contact Clipping": Sutherland-Hodgman, one side plane after
/// the other. Shows the polygon of the last step; clip_story.cpp draws the steps.
namespace contactscope::draw {
namespace {

// Height of a drawn side plane, as a share of the reference face's size.
constexpr double kPlaneHeight = 0.22;

constexpr LineStyle kAboveFace{1.5f, kDropped};

constexpr Swatch kSidePlaneSwatch{LegendGroup::Faces, 1,
                                  [](auto& pen) { pen.area(kSidePlane, 0.2f, 1.2); }};

constexpr Swatch kClippedSegmentSwatch{LegendGroup::Faces, 3,
                                       [](auto& pen) { pen.level_line(0, 22, 4.5, kClipPolygon); }};

// Gregorius 2015, "Sphere vs Hull: Deep Contact" and "Capsule vs Hull: Stacking, Clipping".
void draw_face_of_round(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const auto face = face_of_round(scene, pair);
  if (!face) return;
  sketch.face(face->polygon, with_alpha(kReferenceFace, 0.35f), {3.0f, kReferenceFace});
  sketch.surfaces.back().kind = Surface::Kind::Ground;
  sketch.explain(kReferenceFaceSwatch, "reference face", face->polygon.front());
}

// Whether the same face is filled already, up to rounding: by another pair, or as a triangle of a
// mesh that is touched. Two fills are too strong.
bool is_filled(const trace::Polygon& polygon, const Color& fill, const Sketch& sketch) {
  const double same = 1e-5 * reach_of(polygon);
  return std::ranges::any_of(sketch.surfaces, [&](const Surface& surface) {
    return surface.color == fill &&
           std::ranges::equal(surface.polygon, polygon, [&](const Vec3d& p, const Vec3d& q) {
             return (p - q).norm() <= same;
           });
  });
}

// Gregorius 2015, "Hull vs Hull: Face Contact". In a story, the faces are outlines once the first
// side plane cuts, so that the polygon stands out. In the last step the reference face drops the
// points above it, and is filled again.
template <bool kReference>
void draw_clip_face(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (kReference && !pair.clip) draw_face_of_round(scene, pair, sketch);
  if (!pair.clip) return;
  const trace::Polygon& polygon = (kReference ? pair.clip->reference : pair.clip->incident).polygon;
  const Color color = kReference ? kReferenceFace : kIncidentFace;
  const std::size_t shown = clip_steps_to_show(scene, pair);
  const bool acts = kReference && all_planes_have_cut(scene, pair);
  const bool known = has_clip_story(scene, pair) && shown > 0 && !acts;
  const Color fill = with_alpha(color, 0.35f);
  if (known)
    sketch.outline(polygon, {kReference ? 2.5f : 2.0f, color, !kReference});
  else if (!is_filled(polygon, fill, sketch)) {
    sketch.face(polygon, fill, {3.0f, color, !kReference});
    if (kReference) sketch.surfaces.back().kind = Surface::Kind::Ground;
  } else if (pair.triangle) {
    return;
  }
  sketch.explain(kReference ? kReferenceFaceSwatch : kIncidentFaceSwatch,
                 kReference ? "reference face" : "incident face", near_corner(polygon));
}

double rise_of(const trace::Polygon& face) { return 0.5 * kPlaneHeight * reach_of(face); }

Vec3d top_of_side_plane(const trace::Clip& clip, std::size_t step) {
  const trace::Polygon& face = clip.reference.polygon;
  const Vec3d middle = 0.3 * face[step] + 0.7 * face[(step + 1) % face.size()];
  return middle + rise_of(face) * clip.reference.normal;
}

// Side plane through an edge of a face with the normal `up`; `active`: the plane that cuts now.
void draw_side_plane(const trace::Polygon& face, const Vec3d& up, const Vec3d& outward,
                     std::size_t step, bool active, Sketch& sketch) {
  const Vec3d& from = face[step];
  const Vec3d& to = face[(step + 1) % face.size()];
  const Vec3d rise = (active ? 1.5 : 1.0) * rise_of(face) * up;
  const trace::Polygon corners = {from - rise, to - rise, to + rise, from + rise};
  sketch.face(corners, with_alpha(kSidePlane, active ? 0.5f : 0.36f),
              {active ? 3.0f : 1.5f, kSidePlane});
  const Vec3d middle = 0.5 * (from + to);
  if (active)
    sketch.arrow(middle, outward, 64, 4, 15, kSidePlane);
  else
    sketch.arrow(middle, outward, 30, 1.5f, 8, kSidePlane).halo = false;
}

void draw_side_planes(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (const auto segment = clipped_segment(scene, pair)) {
    // Nearly all planes cut a polygon, but one or none cuts a segment. Others would only hide it.
    for (std::size_t k = 0; k < segment->sides.size(); ++k) {
      if (!segment->cuts(k)) continue;
      draw_side_plane(segment->face, segment->normal, segment->sides[k], k, true, sketch);
      const Vec3d top = segment->face[k] + rise_of(segment->face) * segment->normal;
      sketch.explain(kSidePlaneSwatch, "side plane, outward normal", top);
    }
  }
  const std::size_t shown = clip_steps_to_show(scene, pair);
  const bool story = has_clip_story(scene, pair);
  // After all planes have cut, the last step is about the reference face alone.
  if (all_planes_have_cut(scene, pair)) return;
  // Earlier planes are left out: their corners remain, and the planes would hide them.
  for (std::size_t k = story && shown > 0 ? shown - 1 : 0; k < shown; ++k)
    draw_side_plane(pair.clip->reference.polygon, pair.clip->reference.normal,
                    pair.clip->steps[k].normal, k, story, sketch);
  if (shown > 0)
    sketch.explain(kSidePlaneSwatch, "side plane, outward normal",
                   top_of_side_plane(*pair.clip, shown - 1));
}

void draw_clip_polygons(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (const auto segment = clipped_segment(scene, pair)) {
    sketch.bordered_line(segment->from, segment->to, {4.5f, kClipPolygon}, 8);
    bool is_cut = false;
    for (std::size_t k = 0; k < segment->sides.size(); ++k) is_cut = is_cut || segment->cuts(k);
    sketch.explain(kClippedSegmentSwatch,
                   is_cut ? "axis of the capsule, clipped" : "axis of the capsule",
                   Vec3d(0.7 * segment->from + 0.3 * segment->to));
  }
  const std::size_t shown = clip_steps_to_show(scene, pair);
  const bool story = has_clip_story(scene, pair);
  if (story) draw_clip_story(scene, pair, sketch);
  if (shown == 0 || pair.clip->steps[shown - 1].polygon.empty()) return;
  const trace::Polygon& polygon = pair.clip->steps[shown - 1].polygon;
  sketch.outline(polygon, {story ? 3.5f : 2.5f, kClipPolygon});
  sketch.surfaces.push_back({polygon, with_alpha(kClipPolygon, story ? 0.3f : 0.22f)});
  // While planes cut, other lines cover its sides, and the legend is full.
  if (story && !all_planes_have_cut(scene, pair))
    sketch.label(mean_of(polygon), "clip polygon", kClipPolygon, 17, 0);
  else
    sketch.explain(kClipPolygonSwatch, "clip polygon", middle_of_side(polygon));
}

/// Points that clipping dropped, once all steps are shown.
void draw_dropped(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.clip) return;
  const bool story = has_clip_story(scene, pair);
  if (story && !all_planes_have_cut(scene, pair)) return;
  for (const trace::DroppedPoint& point : pair.clip->dropped) {
    if (is_kept(pair, point)) continue;
    sketch.mark(MarkKind::Cross, point.position, kDropped);
    // Height above the reference face, like the whiskers of the points below it.
    const Vec3d& normal = pair.clip->reference.normal;
    const double above = normal.dot(point.position - pair.clip->reference.polygon.front());
    if (story || scene.shows(Layer::Coherent))
      sketch.line(point.position, point.position - above * normal, kAboveFace);
    sketch.explain(kDroppedSwatch, point.reason, point.position);
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

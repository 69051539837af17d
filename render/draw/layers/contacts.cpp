#include <algorithm>
#include <cmath>

#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/scene.h"
#include "draw/scene/whisker.h"

namespace contactscope::draw {
namespace {

// More crosses than this would hide the polygon on which they stand.
constexpr std::size_t kCrowd = 24;

Vec3d middle_of(const std::vector<trace::Point>& points) {
  Vec3d sum = Vec3d::Zero();
  for (const trace::Point& point : points) sum += point.position;
  return sum / static_cast<double>(points.size());
}

// Pixels. Shorter, an arrow would hide behind the dots of its contact.
constexpr double kLeastArrow = 8;

// Whether an arrow that starts here has room in the view for so many pixels, as it is seen: one that
// points at the eye has not.
bool has_room(const Camera& camera, const Vec3d& from, const Vec3d& direction, double pixels) {
  const std::optional<Point2> a = camera.project(from);
  const std::optional<Point2> b =
      camera.project(from + pixels / camera.pixels_per_metre(from) * direction);
  if (!a || !b || !camera.viewport().contains(*a)) return false;
  const std::optional<Segment2> seen = clip_segment(camera.viewport(), *a, *b);
  return seen && std::hypot(seen->to.x - a->x, seen->to.y - a->y) >= kLeastArrow;
}

// From the surface of A to that of B. Of a point that does not touch yet, the gap, thinner.
void draw_whisker(const Scene& scene, const trace::Pair& pair, const trace::Manifold& manifold,
                  const trace::Point& point, Sketch& sketch) {
  const auto [from, to] = whisker_at(scene, pair, manifold, point);
  const float width = stands_off(point, scene.scales) ? 1.5f : 2.5f;
  sketch.lines.push_back({from, to, {2 * width, with_alpha(kWhite, 0.85f)}, false});
  sketch.lines.push_back({from, to, {width, kContact}, true});
}

void draw_point(const Scene& scene, const trace::Pair& pair, const trace::Manifold& manifold,
                const trace::Point& point, Sketch& sketch) {
  // Points that have an age are drawn by it, with the way between the places that met. Beside them
  // a filled dot means a new point, which those of a one-shot manifold all are and none is.
  const bool ages = scene.shows(Layer::Persistent);
  if (ages && pair.incremental) return;
  const bool apart = stands_off(point, scene.scales);
  const std::string factor =
      scene.depth_factor == 1 ? "" : " × " + spell_number(scene.depth_factor);
  draw_whisker(scene, pair, manifold, point, sketch);
  if (ages && !apart) {
    sketch.marks.push_back({MarkKind::Square, point.position, kContact});
    sketch.explain(LegendKind::OneShotPoint, "one-shot point, whisker = overlap" + factor);
    return;
  }
  sketch.marks.push_back({apart ? MarkKind::Apart : MarkKind::Dot, point.position, kContact});
  if (apart) {
    sketch.explain(LegendKind::ApartPoint,
                   "point within the margin, not touching: line = gap" + factor);
  } else {
    sketch.explain(LegendKind::Contact, "contact point, whisker = overlap" + factor);
  }
}

// The middle of the points. Of a single one, the arrow begins where a whisker that runs the same
// way ends, for it would cover it.
Vec3d start_of_normal(const Scene& scene, const trace::Pair& pair,
                      const trace::Manifold& manifold) {
  const Vec3d middle = middle_of(manifold.points);
  if (manifold.points.size() > 1 || !scene.shows(Layer::Contacts)) return middle;
  const Whisker whisker = whisker_at(scene, pair, manifold, manifold.points.front());
  const double ahead = std::max((whisker.on_a - middle).dot(manifold.normal),
                                (whisker.on_b - middle).dot(manifold.normal));
  return middle + std::max(0.0, ahead) * manifold.normal;
}

}  // namespace

void draw_normals(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const bool many = pair.manifolds.size() > 2;  // a mesh's: arrows as long as usual would be a wood
  for (const trace::Manifold& manifold : pair.manifolds) {
    if (manifold.points.empty()) continue;
    Arrow normal;
    normal.from = start_of_normal(scene, pair, manifold);
    normal.direction = manifold.normal;
    normal.pixels = many ? 44 : 78;
    normal.width = many ? 2 : 3;
    normal.head = many ? 9 : 13;
    normal.color = kNormal;
    if (!has_room(scene.camera, normal.from, normal.direction, normal.pixels)) continue;
    sketch.arrows.push_back(normal);
    sketch.explain(LegendKind::Normal, "normal, from A to B");
  }
}

// Gregorius 2015, "Contact Points", "Contact Manifolds" and "Contact Point Reduction".
void draw_contacts(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (scene.shows(Layer::Normals)) draw_normals(scene, pair, sketch);
  if (pair.manifolds.size() > 1) {  // each was reduced by itself, and the record holds one of these
    for (const trace::Manifold& manifold : pair.manifolds) {
      for (const trace::Point& point : manifold.points) {
        if (scene.shows(Layer::Contacts)) draw_point(scene, pair, manifold, point, sketch);
        if (scene.shows(Layer::Ids)) draw_id(point, sketch);
      }
    }
    return;
  }
  if (pair.manifolds.empty() || pair.manifolds.front().points.empty()) return;

  const trace::Manifold& manifold = pair.manifolds.front();
  const bool reduced = scene.shows(Layer::Reduced) && pair.reduction &&
                       pair.reduction->kept.size() < pair.reduction->points.size();
  const std::vector<trace::Point>& all = pair.reduction ? pair.reduction->points : manifold.points;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::size_t choice = i;
    bool kept = true;
    if (pair.reduction) {
      const std::vector<int>& chosen = pair.reduction->kept;
      const auto found = std::find(chosen.begin(), chosen.end(), static_cast<int>(i));
      kept = found != chosen.end();
      choice = static_cast<std::size_t>(found - chosen.begin());
    }
    if (!kept) {  // no contact
      if (!reduced) continue;
      const bool crowded = all.size() - pair.reduction->kept.size() > kCrowd;
      sketch.marks.push_back(
          {crowded ? MarkKind::SmallCross : MarkKind::Cross, all[i].position, kDropped});
      sketch.explain(LegendKind::Reduced, "reduced away");
      continue;
    }
    if (scene.shows(Layer::Contacts)) draw_point(scene, pair, manifold, all[i], sketch);
    if (reduced) {
      sketch.marks.push_back({MarkKind::Ring, all[i].position, kContact});
      sketch.labels.push_back({.at = all[i].position,
                               .text = std::to_string(choice + 1),
                               .color = kContact,
                               .size = 20,
                               .bold = true,
                               .clearance = 14,
                               .direction = std::nullopt});
      sketch.explain(LegendKind::Kept, "kept, in order of choice");
    }
    if (scene.shows(Layer::Ids)) draw_id(all[i], sketch);
  }
}

}  // namespace contactscope::draw

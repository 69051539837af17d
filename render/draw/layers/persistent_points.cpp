#include <algorithm>
#include <cmath>
#include <optional>

#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

constexpr double kLeastAnchors = 12;  // pixels
constexpr double kCovered = 8;        // pixels

// Where the two places that met when the point was found are now.
void draw_anchors(const Scene& scene, const trace::PersistentPoint& point, Sketch& sketch) {
  const double factor = scene.scales.drift;
  // As long as the dot is wide, they say nothing.
  const double pixels = scene.camera.pixels_per_metre(point.point.position);
  if (factor * pixels * (point.on_b - point.on_a).norm() < kLeastAnchors) return;
  const Vec3d middle = 0.5 * (point.on_a + point.on_b);
  const Vec3d from = middle + factor * (point.on_a - middle);
  const Vec3d to = middle + factor * (point.on_b - middle);
  sketch.lines.push_back({from, to, {3.5f, with_alpha(kWhite, 0.85f)}, false});
  sketch.lines.push_back({from, to, {1.5f, kContact}, true});
  for (const Vec3d& end : {from, to}) sketch.marks.push_back({MarkKind::Core, end, kContact});
  sketch.explain(LegendKind::Anchors,
                 factor == 1 ? "places that met, and how far they are apart now"
                             : "places that met, now apart (× " + spell_number(factor) + ")");
}

std::string state_of(const trace::PersistentPoint& point) {
  if (point.state == "broken") return point.reason;
  if (point.state == "new") return "new";
  return std::to_string(point.age);
}

// Whether a point that holds is drawn over this one.
bool is_covered(const Scene& scene, const trace::Pair& pair, const Vec3d& at) {
  const std::optional<Point2> here = scene.camera.project(at);
  return here && std::ranges::any_of(pair.incremental->points, [&](const auto& other) {
           const std::optional<Point2> there = scene.camera.project(other.point.position);
           return other.state != "broken" && there &&
                  std::hypot(there->x - here->x, there->y - here->y) <
                      kCovered * scene.scales.pixel;
         });
}

void draw_persistent_point(const Scene& scene, const trace::PersistentPoint& point, bool covered,
                           Sketch& sketch) {
  const bool broken = point.state == "broken";
  const bool is_new = point.state == "new";
  draw_anchors(scene, point, sketch);
  sketch.marks.push_back({broken   ? covered ? MarkKind::WideRing : MarkKind::Hollow
                          : is_new ? MarkKind::Dot
                                   : MarkKind::Half,
                          point.point.position, kContact});
  if (broken) {
    sketch.explain(LegendKind::BrokenPoint, "taken out, and why");
  } else if (is_new) {
    sketch.explain(LegendKind::NewPoint, "new point");
  } else {
    sketch.explain(LegendKind::PersistedPoint, "kept point, its age in frames");
  }
  if (scene.shows(Layer::Ids) && !broken) return;  // its id stands there
  sketch.labels.push_back({.at = point.point.position,
                           .text = state_of(point),
                           .color = broken ? kDropped : kContact,
                           .size = broken ? 16.0f : 18.0f,
                           .bold = !broken,
                           .clearance = 12,
                           .direction = std::nullopt});
}

}  // namespace

// Gregorius 2015, "Building Incremental Manifolds": what became of each point in this frame.
void draw_persistent_points(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.incremental) return;
  // One that was taken out is often where the new one is: what holds now is drawn over it, and it
  // is a ring around that.
  for (const bool broken : {true, false}) {
    for (const trace::PersistentPoint& point : pair.incremental->points) {
      if ((point.state == "broken") != broken) continue;
      const bool covered = broken && is_covered(scene, pair, point.point.position);
      draw_persistent_point(scene, point, covered, sketch);
    }
  }
}

}  // namespace contactscope::draw

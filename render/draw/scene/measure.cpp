#include "draw/scene/measure.h"

#include <cmath>

#include "draw/scene/quantity.h"
#include "draw/scene/swatches.h"

namespace contactscope::draw {
namespace {

constexpr double kLeastMeasure = 26;  // pixels: two heads and a bit of line between them
constexpr double kOuterArrow = 24;    // pixels

struct Seen {
  double pixels = 0;
  bool has_room = false;  // for its arrow; a length that is seen as a point has it too
};

/// Empty where an end is behind the eye.
std::optional<Seen> seen(const Scene& scene, const Vec3d& from, const Vec3d& to) {
  const std::optional<Point2> a = scene.camera.project(from), b = scene.camera.project(to);
  if (!a || !b) return std::nullopt;
  const double pixels = std::hypot(b->x - a->x, b->y - a->y);
  return Seen{pixels, pixels >= kLeastMeasure * scene.scales.pixel || pixels <= 0};
}

}  // namespace

void draw_measure(const Scene& scene, const Vec3d& from, const Vec3d& to, float width,
                  Sketch& sketch) {
  const std::optional<Seen> length = seen(scene, from, to);
  if (!length) return;
  Arrow arrow{.from = from, .to = to, .width = width, .head = 10, .color = kAxis};
  if (length->has_room) {
    arrow.double_headed = true;
    sketch.arrows.push_back(arrow);
    return;
  }
  // As drawings measure what is narrow. The arrows are as long on the screen as if seen squarely.
  const Vec3d outward = (from - to) * (kOuterArrow * scene.scales.pixel / length->pixels);
  for (const auto& [tip, way] : {std::pair{from, outward}, {to, Vec3d(-outward)}}) {
    arrow.from = tip + way;
    arrow.to = tip;
    sketch.arrows.push_back(arrow);
  }
}

void explain_measure(const Scene& scene, const Vec3d& from, const Vec3d& to,
                     const std::string& text, Legend& legend) {
  const std::optional<Seen> length = seen(scene, from, to);
  if (length) legend.explain(length->has_room ? kAxisSwatch : kNarrowAxisSwatch, text);
}

void draw_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, double metres,
              double clearance, const Vec3d& aside, Sketch& sketch) {
  draw_measure(scene, from, to, 3, sketch);
  sketch.label(0.5 * (from + to), spell_length(metres), kAxisText, 17, clearance, aside);
}

void explain_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, Legend& legend) {
  explain_measure(scene, from, to, "gap", legend);
}

}  // namespace contactscope::draw

#include "draw/scene/quantity.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

constexpr double kMinMeasure = 26;  // pixels: two heads and a bit of line between them
constexpr double kOuterArrow = 24;  // pixels

}  // namespace

void draw_measure(const Scene& scene, Measured what, const Vec3d& from, const Vec3d& to,
                  float width, const std::string& text, Sketch& sketch) {
  const std::optional<float> pixels = seen_distance(scene.camera, from, to);
  if (!pixels) return;
  const Vec3d middle = 0.5 * (from + to);
  const auto explain = [&](const Swatch& swatch) {
    if (!text.empty()) sketch.explain(swatch, text, middle);
  };
  Arrow arrow{.from = from, .to = to, .width = width, .head = 10, .color = kAxis};
  if (what == Measured::Overlap) {
    arrow.bars = true;
    sketch.arrows.push_back(arrow);
    return explain(kOverlapSwatch);
  }
  // A length seen end-on, which is a point on the screen, counts as long enough.
  if (*pixels >= kMinMeasure * scene.scales.pixel || *pixels <= 0) {
    arrow.double_headed = true;
    sketch.arrows.push_back(arrow);
    return explain(kAxisSwatch);
  }
  // Narrow: arrows from outside, as in technical drawings. Their length on the screen is fixed.
  const Vec3d outward = (from - to) * (kOuterArrow * scene.scales.pixel / *pixels);
  for (const auto& [tip, offset] : {std::pair{from, outward}, {to, Vec3d(-outward)}}) {
    arrow.from = tip + offset;
    arrow.to = tip;
    sketch.arrows.push_back(arrow);
  }
  explain(kNarrowAxisSwatch);
}

void draw_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, double metres, double noise,
              double clearance, const Vec3d& aside, Sketch& sketch) {
  draw_measure(scene, Measured::Gap, from, to, 3, "", sketch);
  sketch.label(0.5 * (from + to), "gap " + spell_length(metres, noise, scene.scales.length),
               kAxisText, 17, clearance, aside);
}

void draw_curved_arrow(const Camera& camera, const Vec3d& center, const Vec3d& axis, double radius,
                       double angle, float width, const Color& color, Sketch& sketch) {
  constexpr double kStep = 0.08;  // radians
  constexpr double kHead = 12;    // pixels
  const Vec3d to_eye = camera.to_eye(center);
  Vec3d front = to_eye - to_eye.dot(axis) * axis;
  front = front.norm() > 0.1 ? Vec3d(front.normalized())
                             : Vec3d(camera.right() - camera.right().dot(axis) * axis).normalized();
  const Vec3d side = axis.cross(front);
  const auto at = [&](double turn) -> Vec3d {
    const double a = turn - 0.5 * angle;
    return center + radius * (std::cos(a) * front + std::sin(a) * side);
  };
  // The head is straight, so the arc ends at its base.
  const double head =
      std::min(0.6 * angle, kHead / std::max(1e-9, radius * camera.pixels_per_metre(center)));
  const int steps = std::max(2, static_cast<int>(std::ceil((angle - head) / kStep)));
  std::vector<Vec3d> arc;
  for (int i = 0; i <= steps; ++i) arc.push_back(at((angle - head) * i / steps));
  sketch.curves.push_back({arc, {width + 3.5f, with_alpha(kWhite, 0.85f)}});
  sketch.curves.push_back({arc, {width, color}});
  sketch.arrow_head(at(angle - head), at(angle), width, kHead, color);
}

}  // namespace contactscope::draw

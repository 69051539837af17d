#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

constexpr double kLeastClosing = 4;  // pixels

// With the decimals that the fastest of the sequence has in three digits: what is left of it when
// the contact has stopped it is then seen to be nothing.
std::string spell_closing(double speed, double fastest) {
  const int decimals =
      fastest > 0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(fastest))), 0, 9) : 0;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, std::abs(speed));
  if (std::abs(speed) < 0.5 * std::pow(10.0, -decimals)) return "0 m/s";
  return (speed < 0 ? "−" : "") + std::string(text.data()) + " m/s";
}

}  // namespace

// Gregorius 2015, "Recap: Solving Contact (2)": of the relative velocity at the point the part along
// the normal, which is all that the contact sees.
void draw_relative_velocity(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const SequenceScales& scales = scene.scales;
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) {
      if (!point.relative_velocity) continue;
      const Vec3d& before = point.relative_velocity->before;
      const double speed = before.dot(manifold.normal);
      const Vec3d whole = scales.velocity * before;
      const Vec3d part = scales.velocity * speed * manifold.normal;
      const double pixels = scene.camera.pixels_per_metre(point.position);
      if (whole.norm() * pixels >= kLeastClosing) {
        Arrow arrow = arrow_to_scale(point.position, whole, 2, 10, kClipPolygon);
        arrow.open = true;
        sketch.arrows.push_back(arrow);
        sketch.explain(LegendKind::RelativeVelocity, "relative velocity at the contact");
        sketch.lines.push_back({point.position + whole,
                                point.position + part,
                                {1.2f, kClipPolygon, true, LineStyle::Hidden::Same},
                                false});
      }
      const bool visible = part.norm() * pixels >= kLeastClosing;
      if (visible)
        sketch.arrows.push_back(arrow_to_scale(point.position, part, 4, 14, kClipPolygon));
      sketch.explain(LegendKind::NormalVelocity, "its part along the normal");
      sketch.labels.push_back({.at = point.position + (visible ? part : Vec3d::Zero()),
                               .text = spell_closing(speed, scales.closing),
                               .color = rgb(0x00694D),
                               .size = 18,
                               .bold = true,
                               .clearance = 12,
                               .direction = scene.camera.right()});
    }
  }
}

}  // namespace contactscope::draw

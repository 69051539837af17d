#include <algorithm>
#include <cmath>

#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr double kMinClosing = 4;  // pixels

constexpr Swatch kWholeSwatch{LegendGroup::Motion, 1,
                              [](auto& pen) { pen.open_arrow(2, kMotion); }};
constexpr Swatch kPartSwatch{LegendGroup::Motion, 2, [](auto& pen) { pen.arrow(4, 11, kMotion); }};

// Decimals as for three digits of the largest speed, so that the rest after a stop is shown as
// zero.
std::string spell_closing(double speed, double fastest) {
  const int decimals =
      fastest > 0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(fastest))), 0, 9) : 0;
  if (std::abs(speed) < 0.5 * std::pow(10.0, -decimals)) return "0 m/s";
  return (speed < 0 ? "−" : "") + printed("%.*f m/s", decimals, std::abs(speed));
}

// Gregorius 2015, "Recap: Solving Contact (2)": of the relative velocity at the point, only the
// part along the normal matters to the contact.
void draw_relative_velocity(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const SequenceScales& scales = scene.scales;
  for (const auto& [manifold, point] : all_points(pair)) {
    if (!point->relative_velocity) continue;
    const Vec3d& at = point->position;
    const Vec3d& before = point->relative_velocity->before;
    const double speed = before.dot(manifold->normal);
    const Vec3d whole = scales.velocity * before;
    const Vec3d part = scales.velocity * speed * manifold->normal;
    const auto is_seen = [&](const Vec3d& offset) {
      return offset.norm() * scene.camera.pixels_per_metre(at) >= kMinClosing;
    };
    if (is_seen(whole)) {
      sketch.arrow_to_scale(at, whole, 2, 10, kMotion).open = true;
      sketch.line(at + whole, at + part, {1.2f, kMotion, true});
      sketch.explain(kWholeSwatch, "relative velocity at the contact, way in " +
                                       spell_quantity(scales.velocity, "s", 1));
    }
    const std::string spelled = spell_closing(speed, scales.closing);
    if (!is_seen(part) && is_seen(whole)) {
      sketch.label(at + whole, "slides at " + spell_quantity(before.norm(), "m/s"), kMotion, 18, 12,
                   whole.normalized());
      continue;
    }
    if (!is_seen(part)) {
      sketch.label(at, spelled + " along the normal", kMotion, 18, 12, scene.camera.right());
      continue;
    }
    sketch.explain(kPartSwatch, "its part along the normal", Vec3d(at + 0.8 * part));
    sketch.arrow_to_scale(at, part, 4, 14, kMotion);
    sketch.label(at + part, spelled, kMotion, 18, 12, scene.camera.right());
  }
}

}  // namespace

const LayerDrawing kRelativeVelocityLayer{.result = draw_relative_velocity};

}  // namespace contactscope::draw

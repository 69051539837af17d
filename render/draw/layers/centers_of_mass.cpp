#include <algorithm>
#include <set>

#include "draw/layers/layer.h"
#include "draw/scene/marks.h"

namespace contactscope::draw {
namespace {

constexpr Swatch kCenterOfMassSwatch{LegendGroup::Masses, 0, [](const SwatchPen& pen) {
                                       draw_quartered_disc(pen.middle(), pen.px(7.5), pen.px(1.4),
                                                           pen.drawing());
                                     }};

/// Without a contact there is no plane to project into.
bool is_projected(const trace::Pair& pair) {
  return pair.stability && pair.stability->verdict != "no contact";
}

// Quartered discs, as drawings have them, and where a body's centre of mass lies over its contact.
void draw_centers_of_mass(const Scene& scene, Sketch& sketch) {
  std::set<std::string_view> drawn;
  const auto draw = [&](const std::string& name, const Vec3d& center) {
    if (drawn.insert(name).second) sketch.mark(MarkKind::Quartered, center, kNormal);
  };
  for (const trace::Pair& pair : scene.frame.pairs) {
    if (!pair.stability) continue;
    const trace::Stability& stability = *pair.stability;
    draw(stability.shape, stability.center_of_mass);
    if (!is_projected(pair)) continue;
    sketch.bordered_line(stability.center_of_mass, stability.projection, {1.6f, kNormal, true},
                         4.0f, with_alpha(kWhite, 0.8f));
    sketch.mark(MarkKind::SmallQuartered, stability.projection, kNormal);
  }
  for (const trace::Body& body : scene.bodies()) draw(body.name, body.center_of_mass);
}

void explain_centers_of_mass(const Scene& scene, Legend& legend) {
  const std::vector<trace::Pair>& pairs = scene.frame.pairs;
  const bool any = std::ranges::any_of(
      pairs, [](const trace::Pair& pair) { return pair.stability.has_value(); });
  if (!any && scene.bodies().empty()) return;
  legend.explain(kCenterOfMassSwatch, std::ranges::any_of(pairs, is_projected)
                                          ? "centre of mass, and its projection"
                                          : "centre of mass");
}

}  // namespace

const LayerDrawing kCenterOfMassLayer{.needs = {&trace::Stages::stability},
                                      .beneath = draw_centers_of_mass,
                                      .explain_frame = explain_centers_of_mass};

}  // namespace contactscope::draw

#include <set>

#include "draw/layers/layer.h"
#include "draw/scene/marks.h"

namespace contactscope::draw {
namespace {

constexpr Swatch kCenterOfMassSwatch{
    LegendGroup::Masses, 0,
    [](auto& pen) { draw_quartered_disc(pen.middle(), pen.px(7.5), pen.px(1.4), pen.drawing()); }};

// Quartered discs, as drawings have them, and where a body's centre of mass lies over its contact:
// without one there is no plane to project into.
void draw_centers_of_mass(const Scene& scene, Sketch& sketch) {
  std::set<std::string_view> drawn;
  bool any_projected = false;
  const auto draw = [&](const std::string& name, const Vec3d& center) {
    if (drawn.insert(name).second) sketch.mark(MarkKind::Quartered, center, kNormal);
  };
  for (const trace::Pair& pair : scene.frame.pairs) {
    if (!pair.stability) continue;
    const trace::Stability& stability = *pair.stability;
    draw(stability.shape, stability.center_of_mass);
    if (stability.verdict == "no contact") continue;
    any_projected = true;
    sketch.bordered_line(stability.center_of_mass, stability.projection, {1.6f, kNormal, true},
                         4.0f, with_alpha(kWhite, 0.8f));
    sketch.mark(MarkKind::SmallQuartered, stability.projection, kNormal);
  }
  for (const trace::Body& body : scene.bodies()) draw(body.name, body.center_of_mass);
  if (!drawn.empty())
    sketch.explain(kCenterOfMassSwatch,
                   any_projected ? "centre of mass, and its projection" : "centre of mass");
}

}  // namespace

const LayerDrawing kCenterOfMassLayer{.needs = {&trace::Stages::stability},
                                      .beneath = draw_centers_of_mass};

}  // namespace contactscope::draw

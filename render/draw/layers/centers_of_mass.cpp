#include <algorithm>

#include "draw/scene/palette.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {

// Quartered discs, as drawings have them, and where a body's centre of mass lies over its contact.
void draw_centers_of_mass(const Scene& scene, Sketch& sketch) {
  std::vector<std::string> drawn;
  bool projected = false;
  for (const trace::Pair& pair : scene.frame.pairs) {
    if (!pair.stability) continue;
    const trace::Stability& stability = *pair.stability;
    if (std::ranges::find(drawn, stability.shape) == drawn.end()) {
      sketch.marks.push_back({MarkKind::Quartered, stability.center_of_mass, kNormal});
      drawn.push_back(stability.shape);
    }
    if (stability.verdict == "no contact") continue;  // there is no plane to project into
    projected = true;
    sketch.lines.push_back(
        {stability.center_of_mass, stability.projection, {4.0f, with_alpha(kWhite, 0.8f)}, false});
    sketch.lines.push_back(
        {stability.center_of_mass, stability.projection, {1.6f, kNormal, true}, true});
    sketch.marks.push_back({MarkKind::SmallQuartered, stability.projection, kNormal});
  }
  if (scene.frame.solver) {
    for (const trace::Body& body : scene.frame.solver->bodies) {
      if (std::ranges::find(drawn, body.name) != drawn.end()) continue;
      sketch.marks.push_back({MarkKind::Quartered, body.center_of_mass, kNormal});
      drawn.push_back(body.name);
    }
  }
  if (!drawn.empty()) {
    sketch.explain(LegendKind::CenterOfMass,
                   projected ? "centre of mass, and its projection" : "centre of mass");
  }
}

}  // namespace contactscope::draw

#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/scene.h"
#include "draw/scene/whisker.h"

namespace contactscope::draw {
namespace {

constexpr double kBeside = 20;     // pixels from the point, clear of its arrows
constexpr double kLeastDepth = 2;  // pixels: less looks like a touch
constexpr double kEqually = 1e-2;  // of the overlap

}  // namespace

void draw_overlap(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const Vec3d left = -scene.camera.right();
  const trace::Manifold* on = nullptr;
  const trace::Point* deepest = nullptr;
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) {
      const double more = deepest == nullptr ? 1 : deepest->separation - point.separation;
      const double equal = -kEqually * point.separation;
      const bool outer = deepest != nullptr && left.dot(point.position - deepest->position) > 0;
      if (more < -equal || (more <= equal && !outer)) continue;
      on = &manifold;
      deepest = &point;
    }
  }
  if (deepest == nullptr || deepest->separation >= 0) return;
  const double pixels = scene.camera.pixels_per_metre(deepest->position);
  const double factor = scene.depth_factor;
  if (-factor * deepest->separation * pixels < kLeastDepth * scene.scales.pixel) return;
  const Whisker whisker = whisker_at(scene, pair, *on, *deepest);
  const Vec3d aside = kBeside * scene.scales.pixel / pixels * left;
  draw_measure(scene, whisker.on_a + aside, whisker.on_b + aside, 2.5f,
               factor == 1 ? "overlap" : "overlap × " + spell_number(factor), sketch);
  sketch.labels.push_back({.at = 0.5 * (whisker.on_a + whisker.on_b) + aside,
                           .text = spell_length(-deepest->separation),
                           .color = kAxisText,
                           .size = 17,
                           .bold = true,
                           .clearance = 12,
                           .direction = left});
}

}  // namespace contactscope::draw

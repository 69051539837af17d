#include "draw/layers/layer.h"
#include "draw/scene/ghost.h"
#include "draw/scene/pairs.h"
#include "draw/scene/quantity.h"
#include "draw/scene/solid.h"

/// Catto 2013, "Continuous Collision": a contact of shapes that do not touch yet limits their
/// approach to the gap. Draws each body's pose one frame later without contacts, and the gap.
namespace contactscope::draw {
namespace {

constexpr double kMinPath = 8;  // pixels
constexpr double kAside = 44;   // pixels from the point, to avoid the impulse arrow

constexpr LineStyle kGhost{2.0f, kDropped, true};

constexpr Swatch kAheadSwatch{LegendGroup::Motion, 4, [](auto& pen) { pen.dashes(2, kDropped); }};

// Distance within which points become contacts: a dashed line, and a measure opposite to the gap's.
void draw_speculative_margin(const Scene& scene, const Vec3d& from, const Vec3d& out,
                             const Vec3d& aside, Sketch& sketch) {
  const double margin = scene.frame.solver->speculative_margin;
  const Vec3d to = from + margin * out;
  if (!(margin > 0) || !scene.camera.sees(to)) return;
  sketch.line(to - 4 * aside, to + 2 * aside, {1.5f, kAxis, true});
  const Vec3d below = -3 * aside;
  sketch.measure(from + below, to + below, 1.8f, 10, kAxis);
  sketch.label(0.5 * (from + to) + below,
               "speculative margin " + spell_length(margin, 0, scene.scales.length), kAxisText, 17,
               10, Vec3d(-scene.camera.up()));
}

void draw_ahead(const Scene& scene, Sketch& sketch) {
  const double step = scene.scales.step;
  if (!scene.frame.solver || step <= 0) return;
  for (const trace::Body& body : scene.bodies()) {
    const Vec3d& center = body.center_of_mass;
    const Vec3d offset = step * body.velocity;
    const double pixels = offset.norm() * scene.camera.pixels_per_metre(center);
    const PlacedShape* shape = scene.find(body.name);
    if (shape == nullptr || pixels < kMinPath * scene.scales.pixel) continue;
    const Vec3d turn = step * body.angular_velocity;
    const PlacedShape later = moved(*shape, center, offset, turn);
    draw_ghost(scene.camera, later, kGhost, sketch);
    draw_path(scene, center, center + offset, border_of_ball(*shape), {1.2f, kDropped, true},
              sketch);
    if (!in_view(scene.camera, later)) continue;
    sketch.explain(kAheadSwatch, "a frame later, if nothing stopped it", Vec3d(center + offset));
  }
  for (const trace::Pair& pair : scene.frame.pairs) {
    const PlacedShape* a = scene.find(pair.a);
    const double side = a == nullptr || a->traced().radius == 0 ? 1 : -1;  // to the other surface
    for (const auto& [manifold, point] : all_points(pair)) {
      if (!stands_off(*point, scene.scales)) continue;
      const Vec3d& from = point->position;
      const Vec3d to = from + side * point->separation * manifold->normal;
      const Vec3d up = scene.camera.up();
      const Vec3d aside = kAside * scene.scales.pixel / scene.camera.pixels_per_metre(from) * up;
      for (const Vec3d& end : {from, to}) sketch.line(end, end + 1.2 * aside, {1.0f, kAxis});
      draw_gap(scene, from + aside, to + aside, point->separation, scene.noise(pair), 12, up,
               sketch);
      draw_speculative_margin(scene, from, side * manifold->normal, aside, sketch);
    }
  }
}

}  // namespace

const LayerDrawing kAheadLayer{.above = draw_ahead};

}  // namespace contactscope::draw

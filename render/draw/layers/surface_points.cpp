#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/quantity.h"

/// Engines store a contact as one point, or as two: on the surface of A and on the surface of B.
/// Draws both and the line between them, as debuggers of physics engines do, and the point midway,
/// which some engines store instead.
namespace contactscope::draw {
namespace {

constexpr Swatch kOnASwatch{LegendGroup::Points, 21, [](auto& pen) { pen.dot(0, 4.0, kArcOfA); },
                            kArcOfA};
constexpr Swatch kOnBSwatch{LegendGroup::Points, 22, [](auto& pen) { pen.dot(2.6, 4.8, kArcOfB); },
                            kArcOfB};
constexpr Swatch kMidwaySwatch{LegendGroup::Points, 23, [](auto& pen) {
                                 draw_square(pen.middle(), pen.px(4.2), kContact, pen.drawing());
                               }};

void draw_surface_points(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::string factor = spell_factor(scene.scales.overlap);
  for (const PairPoint& any : kept_points(pair)) {
    const OnBoth places = whisker_at(scene, pair, any);
    sketch.bordered_line(places.on_a, places.on_b, {1.2f, kShapeEdge}, 3.0f);
    const Vec3d middle = 0.5 * (places.on_a + places.on_b);
    sketch.mark(MarkKind::Square, middle, kContact);
    sketch.explain(kMidwaySwatch, "midway between both", middle);
    sketch.mark(MarkKind::Hollow, places.on_b, kArcOfB);
    sketch.mark(MarkKind::Node, places.on_a, kArcOfA);
    sketch.explain(kOnASwatch, "on the surface of A", places.on_a);
    sketch.explain(kOnBSwatch,
                   "on the surface of B" + (factor.empty() ? factor : ", their distance" + factor));
  }
}

}  // namespace

const LayerDrawing kSurfacePointsLayer{.needs = {&Stages::reduction},
                                       .result = draw_surface_points};

}  // namespace contactscope::draw

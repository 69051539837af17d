#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

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

constexpr Swatch kBeforeMoveSwatch{LegendGroup::Points, 2,
                                   [](auto& pen) { pen.dot(2.6, 4.8, kContact); }};

// Gregorius 2015, "Hull vs Hull: Coherent Points": each point after clipping, and its position on
// the reference face. Kept points were moved along the reference normal by their separation.
void draw_coherent_points(const Scene&, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.clip || pair.manifolds.empty()) return;
  sketch.explain(kBeforeMoveSwatch, "as clipped, on the incident face",
                 pair.manifolds.front().points.empty()
                     ? std::optional<Vec3d>()
                     : pair.manifolds.front().points.front().position);
  sketch.explain(kContactSwatch, "moved onto the reference face");
  const Vec3d& normal = pair.clip->reference.normal;
  for (const trace::Point& point :
       pair.reduction ? pair.reduction->points : pair.manifolds.front().points) {
    const Vec3d before = point.position + point.separation * normal;
    sketch.arrows.push_back({.from = before, .to = point.position, .head = 8, .color = kContact});
    sketch.mark(MarkKind::Hollow, before, kContact);
    sketch.mark(MarkKind::Dot, point.position, kContact);
  }
}

// Smallest displacement of the second shape that changes the pair's points, and its direction.

constexpr float kFlipArrow = 64;  // pixels

constexpr Swatch kFlipSwatch{LegendGroup::Forces, 8, [](auto& pen) { pen.arrow(3, 10, kMotion); }};

void draw_flip_distance(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.flip || !pair.flip->offset) return;
  std::vector<Vec3d> places;
  for (const PairPoint& point : all_points(pair)) places.push_back(point.point->position);
  if (places.empty()) return;
  const Vec3d from = mean_of(places);
  const double pixels = scene.camera.pixels_per_metre(from);
  sketch.arrow(from, pair.flip->direction, kFlipArrow, 3, 12, kMotion);
  const Vec3d tip = from + kFlipArrow * scene.scales.pixel / pixels * pair.flip->direction;
  sketch.explain(kFlipSwatch, "smallest way of B to other points", tip);
  sketch.label(tip, spell_length(*pair.flip->offset), kMotion, 17, 10, pair.flip->direction);
}

}  // namespace

const LayerDrawing kSurfacePointsLayer{.needs = {&Stages::reduction},
                                       .result = draw_surface_points};

const LayerDrawing kCoherentLayer{.needs = {&Stages::clip, &Stages::reduction},
                                  .result = draw_coherent_points};

const LayerDrawing kFlipDistanceLayer{.needs = {&Stages::flip}, .result = draw_flip_distance};

}  // namespace contactscope::draw

#include "draw/layers/layer.h"

namespace contactscope::draw {
namespace {

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

}  // namespace

const LayerDrawing kCoherentLayer{.needs = {&Stages::clip, &Stages::reduction},
                                  .result = draw_coherent_points};

}  // namespace contactscope::draw

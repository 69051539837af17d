#include "draw/scene/palette.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {

// Gregorius 2015, "Hull vs Hull: Coherent Points": where clipping left a point, and where it went
// on the reference face. Kept points were moved along the reference normal by their separation.
void draw_coherent_points(const trace::Pair& pair, Sketch& sketch) {
  if (!pair.clip || pair.manifolds.empty()) return;
  const Vec3d& normal = pair.clip->reference.normal;
  const std::vector<trace::Point>& points =
      pair.reduction ? pair.reduction->points : pair.manifolds.front().points;
  for (const trace::Point& point : points) {
    const Vec3d before = point.position + point.separation * normal;
    Arrow moved;
    moved.from = before;
    moved.to = point.position;
    moved.width = 2;
    moved.head = 8;
    moved.color = kContact;
    sketch.arrows.push_back(moved);
    sketch.marks.push_back({MarkKind::Hollow, before, kContact});
    sketch.marks.push_back({MarkKind::Dot, point.position, kContact});
  }
  sketch.explain(LegendKind::BeforeMove, "as clipped, on the incident face");
  sketch.explain(LegendKind::Contact, "moved onto the reference face");
}

}  // namespace contactscope::draw

#include "draw/layers/layer.h"
#include "draw/scene/answers.h"
#include "draw/scene/quantity.h"

/// The answer to what a pair was asked: the closest or deepest points and what lies between them.
namespace contactscope::draw {
namespace {

constexpr Swatch kPointsSwatch{LegendGroup::Axes, 4, [](auto& pen) { pen.dot(0, 4.0, kAxisText); }};

void draw_answer(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.query || !pair.query->gap || !pair.query->point_a || !pair.query->point_b) return;
  const trace::Query& query = *pair.query;
  // Another question that has the same points for an answer has drawn them already.
  for (const trace::Pair* other = scene.frame.pairs.data(); other != &pair; ++other)
    if (other->a == pair.a && other->b == pair.b && other->query && other->query->gap &&
        other->query->point_a == query.point_a && other->query->point_b == query.point_b)
      return;
  const bool apart = *query.gap >= 0;
  const Vec3d &from = *query.point_a, &to = *query.point_b;
  for (const Vec3d& point : {from, to}) sketch.mark(MarkKind::Node, point, kAxisText);
  sketch.explain(kPointsSwatch, apart ? "closest points" : "deepest points");
  if (from == to || *query.gap == 0) return;  // a measure of rounding
  draw_measure(scene, from, to, 3, apart ? "distance" : "depth", sketch);
  sketch.label(0.5 * (from + to), spell_length(std::abs(*query.gap)), kAxisText, 17, 14,
               scene.camera.right());
}

}  // namespace

const LayerDrawing kAnswerLayer{.search = draw_answer};

}  // namespace contactscope::draw

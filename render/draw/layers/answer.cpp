#include <algorithm>
#include <cmath>

#include "draw/layers/layer.h"
#include "draw/scene/answers.h"
#include "draw/scene/pair_words.h"

/// Answer of a distance or depth query: closest or deepest points and the distance between them.
namespace contactscope::draw {
namespace {

constexpr double kMinOfAnswer = 14;  // pixels: at less, dots hide the measure

constexpr Swatch kPointsSwatch{LegendGroup::Axes, 4, [](auto& pen) { pen.dot(0, 4.0, kAxisText); }};

bool is_near(const std::optional<Vec3d>& p, const std::optional<Vec3d>& q) {
  return p && q && (*p - *q).norm() <= 1e-6 * (p->norm() + q->norm());
}

/// Whether two queries have the same pair of points, in either order of shapes.
bool is_same_measure(const trace::Pair& pair, const trace::Pair& other) {
  const trace::Query &one = *pair.query, &two = *other.query;
  // If faces are equally deep all over, methods find different points. One measure suffices.
  const bool same_length = std::abs(*one.gap - *two.gap) <= 1e-5 * std::abs(*one.gap);
  if (other.a == pair.a && other.b == pair.b)
    return same_length || (is_near(one.point_a, two.point_a) && is_near(one.point_b, two.point_b));
  return other.a == pair.b && other.b == pair.a && is_near(one.point_a, two.point_b) &&
         is_near(one.point_b, two.point_a);
}

/// Whether another query is shorter for one of these shapes. A user who queries several distances
/// of a shape looks for the nearest.
bool is_nearer_elsewhere(const Scene& scene, const trace::Pair& pair) {
  const double gap = *pair.query->gap;
  return std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& other) {
    const int shared =
        (other.a == pair.a || other.a == pair.b) + (other.b == pair.a || other.b == pair.b);
    return shared == 1 && other.query && other.query->gap &&
           *other.query->gap < gap - 1e-5 * std::abs(gap);
  });
}

void draw_answer(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.query || !pair.query->gap || !pair.query->point_a || !pair.query->point_b) return;
  const trace::Query& query = *pair.query;
  // A query with the same points has drawn them already.
  for (const trace::Pair* other = scene.frame.pairs.data(); other != &pair; ++other)
    if (other->query && other->query->gap && is_same_measure(pair, *other)) return;
  const bool separated = *query.gap >= 0;
  const Vec3d &from = *query.point_a, &to = *query.point_b;
  const bool touches = from == to || *query.gap == 0;  // otherwise rounding would be measured
  const std::optional<float> pixels = seen_distance(scene.camera, from, to);
  if (touches || (pixels && *pixels >= kMinOfAnswer * scene.scales.pixel)) {
    for (const Vec3d& point : {from, to}) sketch.mark(MarkKind::Node, point, kAxisText);
    // Otherwise the arrow covers the points.
    if (touches)
      sketch.explain(kPointsSwatch, separated ? "closest points" : "deepest points", from);
  }
  if (touches) return;
  const bool quiet = separated && is_nearer_elsewhere(scene, pair);
  draw_measure(scene, separated ? Measured::Gap : Measured::Overlap, from, to, quiet ? 1.5f : 3, "",
               sketch);
  sketch
      .label(0.5 * (from + to),
             spell_separation(*query.gap, scene.noise(pair), scene.scales.length), kAxisText, 17,
             14, scene.camera.right())
      .bold = !quiet;
}

}  // namespace

const LayerDrawing kAnswerLayer{.search = draw_answer};

}  // namespace contactscope::draw

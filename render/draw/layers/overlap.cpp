#include "draw/layers/layer.h"
#include "draw/scene/arrows.h"
#include "draw/scene/pair_points.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr double kBeside = 20;     // pixels from the point, clear of its arrows
constexpr double kLeastDepth = 2;  // pixels: less looks like a touch
constexpr double kEqually = 1e-2;  // of the overlap

/// How deep the pair is, beside its deepest point: of equally deep ones the outermost.
void draw_overlap(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const Vec3d left = -scene.camera.right();
  std::optional<PairPoint> deepest;
  for (const PairPoint& candidate : all_points(pair)) {
    const trace::Point& point = *candidate.point;
    const double more = deepest ? deepest->point->separation - point.separation : 1;
    const double equal = -kEqually * point.separation;
    const bool outer = deepest && left.dot(point.position - deepest->point->position) > 0;
    if (more < -equal || (more <= equal && !outer)) continue;
    deepest = candidate;
  }
  if (!deepest || deepest->point->separation >= 0) return;
  const trace::Point& point = *deepest->point;
  const double pixels = scene.camera.pixels_per_metre(point.position);
  if (-scene.depth_factor * point.separation * pixels < kLeastDepth * scene.scales.pixel) return;
  const Whisker whisker = whisker_at(scene, pair, *deepest->manifold, point);
  const Vec3d aside = kBeside * scene.scales.pixel / pixels * left;
  const Vec3d from = whisker.on_a + aside, to = whisker.on_b + aside;
  draw_measure(scene, from, to, 2.5f, "overlap" + spell_factor(scene.depth_factor), sketch);
  sketch.label(0.5 * (from + to), spell_length(-point.separation), kAxisText, 17, 12, left);
}

}  // namespace

const LayerDrawing kOverlapLayer{.result = draw_overlap};

}  // namespace contactscope::draw

#include "draw/layers/layer.h"
#include "draw/scene/measure.h"
#include "draw/scene/quantity.h"
#include "draw/scene/whisker.h"

namespace contactscope::draw {
namespace {

constexpr double kBeside = 20;     // pixels from the point, clear of its arrows
constexpr double kLeastDepth = 2;  // pixels: less looks like a touch
constexpr double kEqually = 1e-2;  // of the overlap

struct Overlap {
  Vec3d from, to;     // where it is drawn
  double metres = 0;  // positive
};

/// How deep the pair is, beside its deepest point: of equally deep ones the outermost.
std::optional<Overlap> overlap_of(const Scene& scene, const trace::Pair& pair) {
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
  if (!deepest || deepest->point->separation >= 0) return std::nullopt;
  const trace::Point& point = *deepest->point;
  const double pixels = scene.camera.pixels_per_metre(point.position);
  if (-scene.depth_factor * point.separation * pixels < kLeastDepth * scene.scales.pixel)
    return std::nullopt;
  const Whisker whisker = whisker_at(scene, pair, *deepest->manifold, point);
  const Vec3d aside = kBeside * scene.scales.pixel / pixels * left;
  return Overlap{whisker.on_a + aside, whisker.on_b + aside, -point.separation};
}

}  // namespace

const LayerDrawing kOverlapLayer{
    .result =
        [](const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
          const std::optional<Overlap> overlap = overlap_of(scene, pair);
          if (!overlap) return;
          draw_measure(scene, overlap->from, overlap->to, 2.5f, sketch);
          sketch.label(0.5 * (overlap->from + overlap->to), spell_length(overlap->metres),
                       kAxisText, 17, 12, Vec3d(-scene.camera.right()));
        },
    .explain =
        [](const Scene& scene, const trace::Pair& pair, Legend& legend) {
          const std::optional<Overlap> overlap = overlap_of(scene, pair);
          if (!overlap) return;
          explain_measure(scene, overlap->from, overlap->to,
                          "overlap" + spell_factor(scene.depth_factor), legend);
        },
};

}  // namespace contactscope::draw

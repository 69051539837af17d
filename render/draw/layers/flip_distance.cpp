#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/quantity.h"

/// Smallest displacement of the second shape that changes the pair's points, and its direction.
namespace contactscope::draw {
namespace {

constexpr float kArrow = 64;  // pixels

constexpr Swatch kFlipSwatch{LegendGroup::Forces, 8, [](auto& pen) { pen.arrow(3, 10, kMotion); }};

void draw_flip_distance(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.flip || !pair.flip->offset) return;
  std::vector<Vec3d> places;
  for (const PairPoint& point : all_points(pair)) places.push_back(point.point->position);
  if (places.empty()) return;
  const Vec3d from = mean_of(places);
  const double pixels = scene.camera.pixels_per_metre(from);
  sketch.arrow(from, pair.flip->direction, kArrow, 3, 12, kMotion);
  const Vec3d tip = from + kArrow * scene.scales.pixel / pixels * pair.flip->direction;
  sketch.explain(kFlipSwatch, "smallest way of B to other points", tip);
  sketch.label(tip, spell_length(*pair.flip->offset), kMotion, 17, 10, pair.flip->direction);
}

}  // namespace

const LayerDrawing kFlipDistanceLayer{.needs = {&Stages::flip}, .result = draw_flip_distance};

}  // namespace contactscope::draw

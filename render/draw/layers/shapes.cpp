#include <algorithm>
#include <span>

#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/quantity.h"
#include "draw/scene/solid.h"

namespace contactscope::draw {
namespace {

// A margin narrower than this part of the shape is not seen, and its inside only in the way.
constexpr double kSeenMargin = 0.02;
constexpr Color kInside = with_alpha(kShapeEdge, 0.6f);
constexpr Swatch kMarginSwatch{LegendGroup::Shapes, 2,
                               [](auto& pen) { pen.area(kInside, 0, 1.2, true); }};

bool shows_margin(const PlacedShape& shape) {
  const trace::Shape* const core = shape.mesh->core;
  return core != nullptr && core->margin > kSeenMargin * shape.mesh->radius;
}

// As the segment in a capsule: what lies within the margin.
void draw_core(const PlacedShape& shape, Sketch& sketch) {
  for (int e = 0; e < count_of(shape.mesh->core->edges); ++e)
    if (const auto ends = shape.edge(e)) sketch.line((*ends)[0], (*ends)[1], {1.0f, kInside, true});
}

// In a heap of so many shapes the hidden edges of all would lie over each other as noise.
constexpr std::size_t kHeap = 100;

// Of what was drawn since there were so many lines, curves and marks: no hidden edge, and no core.
void hide_insides(std::size_t lines, std::size_t curves, std::size_t marks, Sketch& sketch) {
  for (Line& line : std::span(sketch.lines).subspan(lines))
    line.style.hidden = LineStyle::Hidden::Gone;
  for (Curve& curve : std::span(sketch.curves).subspan(curves))
    curve.style.hidden = LineStyle::Hidden::Gone;
  sketch.marks.resize(marks);
}

void draw_shapes(const Scene& scene, Sketch& sketch) {
  const std::size_t lines = sketch.lines.size(), curves = sketch.curves.size(),
                    marks = sketch.marks.size();
  for (const PlacedShape& shape : scene.shapes) {
    const Color fill = shape.is_a ? kShapeA : kShapeB;
    if (shape.is_mesh()) {
      draw_mesh(scene, shape, fill, sketch);
    } else {
      const auto draw = shape.traced().half_space   ? draw_plane
                        : shape.traced().radius > 0 ? draw_round
                                                    : draw_solid;
      draw(scene.camera, shape, fill, sketch);
    }
    if (shows_margin(shape)) draw_core(shape, sketch);
  }
  if (scene.shapes.size() > kHeap) hide_insides(lines, curves, marks, sketch);
}

// The widest: a wrong margin is the first thing to look for where bodies float.
void explain_margin(const Scene& scene, Legend& legend) {
  const PlacedShape* widest = nullptr;
  for (const PlacedShape& shape : scene.shapes) {
    if (!shows_margin(shape) || !in_view(scene.camera, shape)) continue;
    if (widest == nullptr || shape.mesh->core->margin > widest->mesh->core->margin) widest = &shape;
  }
  if (widest == nullptr) return;
  const trace::Shape& core = *widest->mesh->core;
  if (!scene.frame.field_slices.empty()) return;  // they have enough signs of their own
  legend.explain(kMarginSwatch, "shape without its margin of " +
                                    spell_length(core.margin, 0, scene.scales.length));
}

// How far the inside of a shape is from what it touches, at the leftmost contact point, once for each shape.
void measure_margin(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  constexpr double kLeastMeasured = 30;  // pixels
  if (scene.crowded() || !scene.shows(Layer::Contacts) || scene.shows(Layer::Core)) return;
  const std::vector<PairPoint> points = all_points(pair);
  if (points.empty() || !scene.frame.field_slices.empty()) return;
  const Vec3d right = scene.camera.right();
  const PairPoint& at = *std::ranges::min_element(
      points, {}, [&](const PairPoint& any) { return right.dot(any.point->position); });
  for (const bool of_a : {true, false}) {
    const std::string& name = of_a ? pair.a : pair.b;
    const PlacedShape* shape = scene.find(name);
    const auto touches = [&](const trace::Pair& other) {
      return (other.a == name || other.b == name) && !other.manifolds.empty();
    };
    if (shape == nullptr || !shows_margin(*shape) ||
        &*std::ranges::find_if(scene.frame.pairs, touches) != &pair)
      continue;
    const double margin = shape->mesh->core->margin;
    const Vec3d from = at.point->position,
                to = from + (of_a ? -margin : margin) * at.manifold->normal;
    const std::optional<float> pixels = seen_distance(scene.camera, from, to);
    if (!pixels || *pixels < kLeastMeasured * scene.scales.pixel) continue;
    sketch.arrows.push_back({.from = from,
                             .to = to,
                             .double_headed = true,
                             .width = 2.2f,
                             .head = 10,
                             .color = kMargin});
    sketch.label(0.5 * (from + to), "margin " + spell_length(margin, 0, scene.scales.length),
                 kMargin, 17, 10, Vec3d(-right));
  }
}

}  // namespace

const LayerDrawing kShapesLayer{
    .beneath = draw_shapes, .result = measure_margin, .explain = explain_margin};

}  // namespace contactscope::draw

#include "draw/layers/layer.h"
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

void draw_shapes(const Scene& scene, Sketch& sketch) {
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

}  // namespace

const LayerDrawing kShapesLayer{.beneath = draw_shapes, .explain = explain_margin};

}  // namespace contactscope::draw

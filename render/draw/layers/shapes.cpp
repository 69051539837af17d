#include "draw/layers/layer.h"
#include "draw/scene/solid.h"

namespace contactscope::draw {
namespace {

constexpr std::size_t kMostNames = 5;  // of one role in the legend

constexpr Swatch kShapeASwatch{LegendGroup::Shapes, 0,
                               [](auto& pen) { pen.box(kShapeA, kShapeEdge, 1.5); }};
constexpr Swatch kShapeBSwatch{LegendGroup::Shapes, 1,
                               [](auto& pen) { pen.box(kShapeB, kShapeEdge, 1.5); }};

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
  }
}

// By name; a whole stack as one entry.
void explain_shapes(const Scene& scene, Legend& legend) {
  if (scene.frame.broad_phase) return;  // no shape has a role
  for (const bool of_a : {true, false}) {
    std::vector<std::string> names;
    for (const PlacedShape& shape : scene.shapes) {
      if (shape.is_a == of_a && in_view(scene.camera, shape)) names.push_back(shape.traced().name);
    }
    if (names.size() > kMostNames) names = {names.front() + " to " + names.back()};
    for (const std::string& name : names)
      legend.explain(of_a ? kShapeASwatch : kShapeBSwatch, (of_a ? "A: " : "B: ") + name);
  }
}

}  // namespace

const LayerDrawing kShapesLayer{.beneath = draw_shapes, .explain = explain_shapes};

}  // namespace contactscope::draw

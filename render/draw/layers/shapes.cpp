#include "draw/layers/layer.h"
#include "draw/scene/mesh_surface.h"
#include "draw/scene/plane_patch.h"
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
    const trace::Shape& solid = *shape.mesh->shape;
    if (solid.half_space) {
      draw_plane(scene, shape, sketch);
    } else if (solid.type == "mesh") {
      draw_mesh(scene, shape, sketch);
    } else if (solid.radius > 0) {
      draw_round(scene.camera, shape, shape.is_a ? kShapeA : kShapeB, sketch);
    } else {
      draw_solid(scene.camera, shape, shape.is_a ? kShapeA : kShapeB, sketch);
    }
  }
}

// By name; a whole stack as one entry.
void explain_shapes(const Scene& scene, Legend& legend) {
  for (const bool of_a : {true, false}) {
    std::vector<std::string> names;
    for (const PlacedShape& shape : scene.shapes) {
      if (shape.is_a == of_a && in_view(scene.camera, shape))
        names.push_back(shape.mesh->shape->name);
    }
    if (names.size() > kMostNames) names = {names.front() + " to " + names.back()};
    for (const std::string& name : names)
      legend.explain(of_a ? kShapeASwatch : kShapeBSwatch, (of_a ? "A: " : "B: ") + name);
  }
}

}  // namespace

const LayerDrawing kShapesLayer{.beneath = draw_shapes, .explain = explain_shapes};

}  // namespace contactscope::draw

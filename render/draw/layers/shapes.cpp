#include <array>
#include <string_view>

#include "draw/layers/layer.h"
#include "draw/scene/quantity.h"
#include "draw/scene/solid.h"

namespace contactscope::draw {
namespace {

constexpr std::size_t kMostEntries = 3;  // in the legend, of both roles, with a name each
constexpr std::size_t kMostNames = 3;    // in one entry

constexpr Swatch kShapeASwatch{LegendGroup::Shapes, 0,
                               [](auto& pen) { pen.box(kShapeA, kShapeEdge, 1.5); }};
constexpr Swatch kShapeBSwatch{LegendGroup::Shapes, 1,
                               [](auto& pen) { pen.box(kShapeB, kShapeEdge, 1.5); }};

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

/// Without the number at the end.
std::string_view stem_of(std::string_view name) {
  const std::size_t last = name.find_last_not_of("0123456789_- ");
  return name.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

/// "slab, crate"; of a whole stack "crate_1 to crate_6"; else "8 shapes".
std::string in_one_entry(const std::vector<std::string>& names) {
  if (names.size() > kMostNames) {
    return stem_of(names.front()) == stem_of(names.back())
               ? names.front() + " to " + names.back()
               : std::to_string(names.size()) + " shapes";
  }
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

// The widest, by name: a wrong margin is the first thing to look for where bodies float.
void explain_margin(const Scene& scene, Legend& legend) {
  const PlacedShape* widest = nullptr;
  for (const PlacedShape& shape : scene.shapes) {
    if (!shows_margin(shape) || !in_view(scene.camera, shape)) continue;
    if (widest == nullptr || shape.mesh->core->margin > widest->mesh->core->margin) widest = &shape;
  }
  if (widest == nullptr) return;
  const trace::Shape& core = *widest->mesh->core;
  legend.explain(kMarginSwatch, core.name + " without its margin of " + spell_length(core.margin));
}

// By name. Where these are many, a role has one entry, and the rest of the legend its room.
void explain_shapes(const Scene& scene, Legend& legend) {
  if (scene.frame.broad_phase) return;  // no shape has a role
  // A slice is about the field, whatever its name, and has enough signs of its own.
  if (!scene.frame.field_slices.empty()) return;
  std::array<std::vector<std::string>, 2> names;  // of A, of B
  for (const PlacedShape& shape : scene.shapes)
    if (in_view(scene.camera, shape)) names[shape.is_a ? 0 : 1].push_back(shape.traced().name);
  const bool many = names[0].size() + names[1].size() > kMostEntries;
  for (const bool of_a : {true, false}) {
    std::vector<std::string>& own = names[of_a ? 0 : 1];
    if (many && !own.empty()) own = {in_one_entry(own)};
    for (const std::string& name : own)
      legend.explain(of_a ? kShapeASwatch : kShapeBSwatch, (of_a ? "A: " : "B: ") + name);
  }
  explain_margin(scene, legend);
}

}  // namespace

const LayerDrawing kShapesLayer{.beneath = draw_shapes, .explain = explain_shapes};

}  // namespace contactscope::draw

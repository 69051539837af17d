#include <algorithm>

#include "draw/insets/simplex_steps.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/scene.h"

/// The support points on both shapes that a simplex, or the nearest face of a polytope, is the
/// difference of. They bear the same numbers as its vertices.
namespace contactscope::draw {
namespace {

/// A point of a shape, which may be in several vertices.
struct SupportPoint {
  Vec3d at;
  std::vector<int> numbers;
};

std::vector<SupportPoint> points_of(const std::vector<trace::SimplexVertex>& vertices,
                                    const std::vector<int>& numbers, bool of_a) {
  std::vector<SupportPoint> points;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3d& at = of_a ? vertices[i].a : vertices[i].b;
    const auto known =
        std::ranges::find_if(points, [&](const SupportPoint& point) { return point.at == at; });
    if (known != points.end()) {
      known->numbers.push_back(numbers[i]);
    } else {
      points.push_back({at, {numbers[i]}});
    }
  }
  return points;
}

}  // namespace

void draw_simplex_points(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::optional<SimplexStep> step = simplex_step(scene.view, scene.frame, pair);
  if (!step) return;
  std::vector<trace::SimplexVertex> vertices = step->vertices;
  std::vector<int> numbers = step->numbers;
  const bool epa = step->polytope != nullptr;
  const Color color = epa ? kReferenceFace : kClipPolygon;
  if (epa) {
    if (step->polytope->nearest < 0) return;
    vertices.clear();
    numbers.clear();
    for (const int corner :
         step->polytope->faces[static_cast<std::size_t>(step->polytope->nearest)]) {
      vertices.push_back(step->vertices[static_cast<std::size_t>(corner)]);
      numbers.push_back(step->numbers[static_cast<std::size_t>(corner)]);
    }
  }
  for (const bool of_a : {true, false}) {
    const std::vector<SupportPoint> points = points_of(vertices, numbers, of_a);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = i + 1; j < points.size(); ++j)
        sketch.lines.push_back({points[i].at, points[j].at, {2.5f, color}});
      std::vector<int> in_order = points[i].numbers;
      std::ranges::sort(in_order);
      std::string text;
      for (const int number : in_order) text += (text.empty() ? "" : " ") + std::to_string(number);
      sketch.marks.push_back({MarkKind::Dot, points[i].at, color});
      sketch.labels.push_back({.at = points[i].at,
                               .text = text,
                               .color = color,
                               .size = 17,
                               .bold = true,
                               .clearance = 10,
                               .direction = std::nullopt});
    }
  }
  if (!vertices.empty())
    sketch.explain(epa ? LegendKind::FacePoints : LegendKind::SimplexPoints,
                   epa ? "support points of the nearest face" : "support points of the simplex");
  if (!step->last()) return;
  const bool apart = !epa && pair.gjk && pair.gjk->status == "separated";
  if (!epa && !apart) return;
  const Vec3d& from = epa ? pair.penetration->point_a : pair.gjk->point_a;
  const Vec3d& to = epa ? pair.penetration->point_b : pair.gjk->point_b;
  Arrow arrow;
  arrow.from = from;
  arrow.to = to;
  arrow.double_headed = true;
  arrow.width = 3;
  arrow.color = kAxis;
  sketch.arrows.push_back(arrow);
  sketch.labels.push_back({.at = 0.5 * (from + to),
                           .text = epa ? "depth " + spell_length(pair.penetration->depth)
                                       : spell_length(pair.gjk->distance),
                           .color = kAxisText,
                           .size = 17,
                           .bold = true,
                           .clearance = 14,
                           .direction = std::nullopt});
}

}  // namespace contactscope::draw

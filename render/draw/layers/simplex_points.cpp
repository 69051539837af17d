#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/quantity.h"
#include "draw/scene/simplex_steps.h"

/// The support points on both shapes that a simplex, or the nearest face of a polytope, is the
/// difference of. They bear the same numbers as its vertices.
namespace contactscope::draw {
namespace {

constexpr Swatch kSimplexPointsSwatch{LegendGroup::Differences, 3,
                                      [](auto& pen) { pen.dot(0, 4.8, kClipPolygon); }};
constexpr Swatch kFacePointsSwatch{LegendGroup::Differences, 4,
                                   [](auto& pen) { pen.dot(0, 4.8, kReferenceFace); }};

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

/// What the layer shows: a simplex, or the nearest face of a polytope.
struct Support {
  SimplexStep step;
  std::vector<trace::SimplexVertex> vertices;
  std::vector<int> numbers;
  bool of_polytope = false;
};

std::optional<Support> support_of(const Scene& scene, const trace::Pair& pair) {
  const std::optional<SimplexStep> step = simplex_step(scene.view, scene.frame, pair);
  if (!step) return std::nullopt;
  if (step->polytope == nullptr) return Support{*step, step->vertices, step->numbers};
  if (step->polytope->nearest < 0) return std::nullopt;
  Support support{*step, {}, {}, true};
  for (const int corner :
       step->polytope->faces[static_cast<std::size_t>(step->polytope->nearest)]) {
    support.vertices.push_back(step->vertices[static_cast<std::size_t>(corner)]);
    support.numbers.push_back(step->numbers[static_cast<std::size_t>(corner)]);
  }
  return support;
}

void draw_simplex_points(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::optional<Support> support = support_of(scene, pair);
  if (!support) return;
  const bool epa = support->of_polytope;
  const Color color = epa ? kReferenceFace : kClipPolygon;
  if (!support->vertices.empty())
    sketch.explain(epa ? kFacePointsSwatch : kSimplexPointsSwatch,
                   epa ? "support points of the nearest face" : "support points of the simplex");
  for (const bool of_a : {true, false}) {
    const std::vector<SupportPoint> points = points_of(support->vertices, support->numbers, of_a);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = i + 1; j < points.size(); ++j)
        sketch.line(points[i].at, points[j].at, {2.5f, color});
      std::vector<int> in_order = points[i].numbers;
      std::ranges::sort(in_order);
      std::string text;
      for (const int number : in_order) text += (text.empty() ? "" : " ") + std::to_string(number);
      sketch.mark(MarkKind::Dot, points[i].at, color);
      sketch.label(points[i].at, text, color, 17, 10);
    }
  }
  const bool apart = !epa && pair.gjk && pair.gjk->status == "separated";
  if (!support->step.last() || (!epa && !apart)) return;
  const Vec3d& from = epa ? pair.penetration->point_a : pair.gjk->point_a;
  const Vec3d& to = epa ? pair.penetration->point_b : pair.gjk->point_b;
  sketch.arrows.push_back(
      {.from = from, .to = to, .double_headed = true, .width = 3, .color = kAxis});
  sketch.label(
      0.5 * (from + to),
      epa ? "depth " + spell_length(pair.penetration->depth) : spell_length(pair.gjk->distance),
      kAxisText, 17, 14);
}

}  // namespace

const LayerDrawing kSimplexLayer{.needs = {&trace::Stages::gjk, &trace::Stages::penetration},
                                 .search = draw_simplex_points};

}  // namespace contactscope::draw

#include "draw/layers/layer.h"
#include "draw/scene/clip_story.h"

/// Support points on both shapes whose differences are the vertices of a simplex, or of the nearest
/// face of a polytope. They have the same numbers as these vertices.
namespace contactscope::draw {
namespace {

constexpr Swatch kSimplexPointsSwatch{LegendGroup::Differences, 3,
                                      [](auto& pen) { pen.dot(0, 4.8, kClipPolygon); }};
constexpr Swatch kFacePointsSwatch{LegendGroup::Differences, 4,
                                   [](auto& pen) { pen.dot(0, 4.8, kPolytope); }};

constexpr Swatch kGapEndsSwatch{LegendGroup::Axes, 4,
                                [](auto& pen) { pen.dot(0, 4.0, kAxisText); }};

/// A point of a shape, which may belong to several vertices.
struct SupportPoint {
  Vec3d at;
  std::multiset<int> numbers;
};

std::vector<SupportPoint> points_of(const SimplexStep& step, const std::vector<int>& vertices,
                                    bool of_a) {
  std::vector<SupportPoint> points;
  for (const int i : vertices) {
    const Vec3d& place = of_a ? at(step.vertices, i).a : at(step.vertices, i).b;
    auto known = std::ranges::find(points, place, &SupportPoint::at);
    if (known == points.end()) known = points.insert(known, SupportPoint{place, {}});
    known->numbers.insert(at(step.numbers, i));
  }
  return points;
}

void draw_simplex_points(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::optional<SimplexStep> step = simplex_step(scene.view, scene.frame, pair);
  const bool epa = step && step->polytope != nullptr;
  if (!step || (epa && step->polytope->nearest < 0)) return;
  std::vector<int> shown(step->vertices.size());  // indices of all vertices, or of the nearest face
  std::iota(shown.begin(), shown.end(), 0);
  if (epa) {
    const std::array<int, 3>& nearest = at(step->polytope->faces, step->polytope->nearest);
    shown.assign(nearest.begin(), nearest.end());
  }
  const Color color = epa ? kPolytope : kClipPolygon;
  if (!shown.empty())
    sketch.explain(epa ? kFacePointsSwatch : kSimplexPointsSwatch,
                   epa ? "support points of the nearest face" : "support points of the simplex",
                   step->vertices[static_cast<std::size_t>(shown.front())].a);
  for (const bool of_a : {true, false}) {
    const std::vector<SupportPoint> points = points_of(*step, shown, of_a);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = i + 1; j < points.size(); ++j)
        sketch.line(points[i].at, points[j].at, {2.5f, color, !of_a});  // dashed on B
      const std::string text = separated(points[i].numbers, ", ");
      sketch.mark(MarkKind::Dot, points[i].at, color);
      sketch.label(points[i].at, text, color, 15, 10).badge = Badge::Support;
      sketch.labels.back().leader = points[i].numbers.size() > 1;
    }
  }
  const bool separated = !epa && pair.gjk && pair.gjk->status == "separated";
  if (!step->last() || (!epa && !separated)) return;
  const Vec3d& from = epa ? pair.penetration->point_a : pair.gjk->point_a;
  const Vec3d& to = epa ? pair.penetration->point_b : pair.gjk->point_b;
  sketch.arrows.push_back(
      {.from = from, .to = to, .double_headed = !epa, .bars = epa, .width = 3, .color = kAxis});
  if (!epa) {
    for (const Vec3d& end : {from, to}) sketch.mark(MarkKind::Dot, end, kAxisText);
    sketch.explain(kGapEndsSwatch, "closest points", from);
  }
  sketch.label(
      0.5 * (from + to),
      (epa ? "overlap " : "gap ") + spell_length(epa ? pair.penetration->depth : pair.gjk->distance,
                                                 scene.noise(pair), scene.scales.length),
      kAxisText, 17, 14);
}

}  // namespace

const LayerDrawing kSimplexLayer{.needs = {&Stages::gjk, &Stages::penetration},
                                 .search = draw_simplex_points};

}  // namespace contactscope::draw

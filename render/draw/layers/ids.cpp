#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

// More names than this would be a thicket.
constexpr std::size_t kMostEdgeNames = 12;

// Catto 2007, "Feature-Based Contact Points": the ids, and the edges that they consist of, each
// named beside it. Those of a mesh count within a triangle, and a round shape has none that is seen.
void draw_ids(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  for (const PairPoint& kept : kept_points(pair))
    sketch.label(kept.point->position, kept.point->id, kText, 15, 12);
  std::vector<PairEdge> edges;
  for (const PairPoint& any : all_points(pair)) {
    for (const PairEdge& edge : edges_in(any.point->id)) {
      if (std::ranges::find(edges, edge) == edges.end()) edges.push_back(edge);
    }
  }
  if (edges.size() > kMostEdgeNames) return;
  for (const auto& [of_a, index] : edges) {
    const PlacedShape* shape = scene.find(of_a ? pair.a : pair.b);
    if (shape == nullptr || shape->is_mesh()) continue;
    const auto ends = shape->edge(index);
    if (!ends || shape->traced().radius > 0) continue;
    sketch
        .label(0.5 * ((*ends)[0] + (*ends)[1]), (of_a ? "a:e" : "b:e") + std::to_string(index),
               kQuietText, 15, 5)
        .bold = false;
  }
}

}  // namespace

const LayerDrawing kIdsLayer{.needs = {&Stages::reduction}, .result = draw_ids};

}  // namespace contactscope::draw

#include <algorithm>
#include <charconv>
#include <string_view>

#include "draw/layers/layer.h"
#include "draw/scene/pair_points.h"

namespace contactscope::draw {
namespace {

// More names than this would be a thicket.
constexpr std::size_t kMostEdgeNames = 12;

// The words of an id such as "a:e3 b:e7" that name edges, those of a as {true, 3}.
void add_edges(std::string_view id, std::vector<std::pair<bool, int>>& edges) {
  while (!id.empty()) {
    const std::size_t end = std::min(id.find(' '), id.size());
    const std::string_view word = id.substr(0, end);
    id.remove_prefix(std::min(end + 1, id.size()));
    if (word.size() < 4 || word.substr(1, 2) != ":e") continue;
    int index = -1;
    const auto parsed = std::from_chars(word.data() + 3, word.data() + word.size(), index);
    if (parsed.ec != std::errc() || parsed.ptr != word.data() + word.size()) continue;
    const std::pair<bool, int> edge(word[0] == 'a', index);
    if (std::ranges::find(edges, edge) == edges.end()) edges.push_back(edge);
  }
}

// Catto 2007, "Feature-Based Contact Points": the ids, and the edges that they consist of, each
// named beside it. Those of a mesh count within a triangle, and a round shape has none that is seen.
void draw_ids(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  for (const PairPoint& kept : kept_points(pair))
    sketch.label(kept.point->position, kept.point->id, kText, 15, 12);
  std::vector<std::pair<bool, int>> edges;
  for (const PairPoint& any : all_points(pair)) add_edges(any.point->id, edges);
  if (edges.size() > kMostEdgeNames) return;
  for (const auto& [of_a, index] : edges) {
    const PlacedShape* shape = scene.find(of_a ? pair.a : pair.b);
    if (shape == nullptr || shape->mesh->shape->type == "mesh") continue;
    const auto ends = shape->edge(index);
    if (!ends || shape->mesh->shape->radius > 0) continue;
    sketch
        .label(0.5 * ((*ends)[0] + (*ends)[1]), (of_a ? "a:e" : "b:e") + std::to_string(index),
               kQuietText, 15, 5)
        .bold = false;
  }
}

}  // namespace

const LayerDrawing kIdsLayer{.needs = {&trace::Stages::reduction}, .result = draw_ids};

}  // namespace contactscope::draw

#include <algorithm>
#include <charconv>
#include <string_view>

#include "draw/scene/palette.h"
#include "draw/scene/scene.h"

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

}  // namespace

void draw_id(const trace::Point& point, Sketch& sketch) {
  sketch.labels.push_back({.at = point.position,
                           .text = point.id,
                           .color = kText,
                           .size = 15,
                           .bold = true,
                           .clearance = 12,
                           .direction = std::nullopt});
}

// Catto 2007, "Feature-Based Contact Points": the edges that an id consists of. Those of a mesh
// count within a triangle, and a round shape has none that is seen.
void draw_edge_names(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  std::vector<std::pair<bool, int>> edges;
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) add_edges(point.id, edges);
  }
  if (edges.size() > kMostEdgeNames) return;
  for (const auto& [of_a, index] : edges) {
    const PlacedShape* shape = scene.find(of_a ? pair.a : pair.b);
    if (shape == nullptr) continue;
    const trace::Shape& solid = *shape->mesh->shape;
    if (solid.type == "mesh" || solid.radius > 0) continue;
    if (index < 0 || static_cast<std::size_t>(index) >= solid.edges.size()) continue;
    const std::array<int, 2>& ends = solid.edges[static_cast<std::size_t>(index)];
    const Vec3d middle = 0.5 * (shape->vertices[static_cast<std::size_t>(ends[0])] +
                                shape->vertices[static_cast<std::size_t>(ends[1])]);
    sketch.labels.push_back({.at = middle,
                             .text = (of_a ? "a:e" : "b:e") + std::to_string(index),
                             .color = kQuietText,
                             .size = 15,
                             .bold = false,
                             .clearance = 5,
                             .direction = std::nullopt});
  }
}

}  // namespace contactscope::draw

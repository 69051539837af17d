#include <cstdlib>
#include <optional>
#include <string>

#include "draw/scene/palette.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

/// The edge that "a:e3 b:e7" names of a shape; `owner` is "a:e" or "b:e".
std::optional<int> edge_in_id(const std::string& id, const std::string& owner) {
  const std::size_t at = id.find(owner);
  if (at == std::string::npos) return std::nullopt;
  const char* digits = id.c_str() + at + owner.size();
  char* end = nullptr;
  const long index = std::strtol(digits, &end, 10);
  return end == digits ? std::nullopt : std::optional<int>(static_cast<int>(index));
}

void draw_deciding_edge(const Scene& scene, const std::string& name, int edge, bool lit,
                        Sketch& sketch) {
  const PlacedShape* shape = scene.find(name);
  if (shape == nullptr || edge < 0) return;
  const std::vector<std::array<int, 2>>& edges = shape->mesh->shape->edges;
  if (static_cast<std::size_t>(edge) >= edges.size()) return;
  const std::array<int, 2>& ends = edges[static_cast<std::size_t>(edge)];
  const Vec3d& from = shape->vertices[static_cast<std::size_t>(ends[0])];
  const Vec3d& to = shape->vertices[static_cast<std::size_t>(ends[1])];
  if (lit) sketch.lines.push_back({from, to, {5.0f, kAxis}});
  // At the end that is nearer to the eye, where the other edge is not.
  const bool first = scene.camera.to_camera(from).z() < scene.camera.to_camera(to).z();
  const Vec3d& near = first ? from : to;
  sketch.labels.push_back({.at = near,
                           .text = "edge " + std::to_string(edge),
                           .color = kAxisText,
                           .size = 16,
                           .bold = true,
                           .clearance = 9,
                           .direction = near - 0.5 * (from + to)});
}

}  // namespace

void draw_deciding_edges(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (pair.sat) {
    // The layer of the axis has drawn them; on the Gauss map they bear numbers.
    if (pair.sat->chosen != "edge_edge" || !pair.sat->edge || pair.sat->edge_pairs.empty()) return;
    draw_deciding_edge(scene, pair.a, pair.sat->edge->a, false, sketch);
    draw_deciding_edge(scene, pair.b, pair.sat->edge->b, false, sketch);
  } else {
    if (pair.manifolds.empty() || pair.manifolds.front().axis != "edge_edge") return;
    if (pair.manifolds.front().points.empty()) return;
    const std::string& id = pair.manifolds.front().points.front().id;
    const std::optional<int> of_a = edge_in_id(id, "a:e"), of_b = edge_in_id(id, "b:e");
    if (!of_a || !of_b) return;
    draw_deciding_edge(scene, pair.a, *of_a, true, sketch);
    draw_deciding_edge(scene, pair.b, *of_b, true, sketch);
  }
  sketch.explain(LegendKind::DecidingEdges, "edges that make the axis");
}

}  // namespace contactscope::draw

#include "geometry/triangulate_faces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include "geometry/hull_from_polygons.h"
#include "geometry/triangulate_polygon.h"

namespace contactscope {
namespace {

using Edges = std::set<std::pair<int, int>>;

std::pair<int, int> edge_between(int one, int other) {
  return {std::min(one, other), std::max(one, other)};
}

Edges edges_of(const Hull<double>& hull) {
  Edges edges;
  for (std::size_t i = 0; i < hull.half_edges.size(); i += 2) {
    edges.insert(edge_between(hull.half_edges[i].origin, hull.half_edges[i + 1].origin));
  }
  return edges;
}

/// Triangles of one face as vertex indices, or the whole face where a cut is an edge already; adds
/// the cuts to `edges`.
std::vector<std::vector<int>> cut_face(const Hull<double>& hull, int face, Edges& edges) {
  const std::vector<int> loop = face_vertices(hull, face);
  if (loop.size() == 3) return {loop};
  std::vector<Vec3d> corners;
  for (const int vertex : loop) corners.push_back(hull.vertices[static_cast<std::size_t>(vertex)]);

  const std::size_t count = loop.size();
  std::vector<std::vector<int>> triangles;
  Edges cuts;
  for (const std::array<int, 3>& corner : triangulate_polygon(corners)) {
    std::vector<int>& triangle = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = static_cast<std::size_t>(corner[k]);
      const std::size_t to = static_cast<std::size_t>(corner[(k + 1) % 3]);
      triangle.push_back(loop[from]);
      if (to != (from + 1) % count) cuts.insert(edge_between(loop[from], loop[to]));
    }
  }
  for (const auto& cut : cuts) {
    if (edges.contains(cut)) return {loop};
  }
  edges.merge(cuts);
  return triangles;
}

}  // namespace

Hull<double> triangulate_faces(const Hull<double>& hull) {
  Edges edges = edges_of(hull);
  std::vector<std::vector<int>> faces;
  std::vector<Plane<double>> planes;
  for (int face = 0; face < hull.face_count(); ++face) {
    for (std::vector<int>& part : cut_face(hull, face, edges)) {
      faces.push_back(std::move(part));
      planes.push_back(hull.planes[static_cast<std::size_t>(face)]);
    }
  }
  Hull<double> cut = hull_from_polygons(hull.vertices, faces);
  cut.planes = std::move(planes);
  cut.centroid = hull.centroid;
  cut.radius = hull.radius;
  lay_out(cut);
  return cut;
}

}  // namespace contactscope

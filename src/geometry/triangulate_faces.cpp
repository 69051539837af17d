#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "core/at.h"
#include "geometry/hull_builder.h"
#include "geometry/hull_from_polygons.h"
#include "geometry/triangulate_polygon.h"

namespace contactscope {
namespace {

using Edges = std::set<std::pair<int, int>>;  // the lower vertex first

/// Triangles of one face as vertex indices, or the whole face where a cut is an edge already; adds
/// the cuts to `edges`.
std::vector<std::vector<int>> cut_face(const Hull<double>& hull, int face, Edges& edges) {
  const std::vector<int> loop = face_vertices(hull, face);
  if (loop.size() == 3) return {loop};
  const std::vector<Vec3d> corners =
      mapped(loop, [&](int vertex) { return at(hull.vertices, vertex); });
  std::vector<std::vector<int>> triangles;
  Edges cuts;
  for (const std::array<int, 3>& corner : triangulate_polygon(corners)) {
    triangles.push_back(mapped(corner, [&](int k) { return at(loop, k); }));
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = corner[k], to = corner[(k + 1) % 3];
      if (to != (from + 1) % count_of(loop))
        cuts.insert(std::minmax({at(loop, from), at(loop, to)}));
    }
  }
  const auto is_edge = [&](const std::pair<int, int>& cut) { return edges.contains(cut); };
  if (std::ranges::any_of(cuts, is_edge)) return {loop};
  edges.merge(cuts);
  return triangles;
}

}  // namespace

Hull<double> triangulate_faces(const Hull<double>& hull) {
  Edges edges;
  for (std::size_t i = 0; i < hull.half_edges.size(); i += 2)
    edges.insert(std::minmax({hull.half_edges[i].origin, hull.half_edges[i + 1].origin}));
  std::vector<std::vector<int>> faces;
  std::vector<Plane<double>> planes;
  for (int face = 0; face < hull.face_count(); ++face) {
    for (std::vector<int>& part : cut_face(hull, face, edges)) {
      faces.push_back(std::move(part));
      planes.push_back(at(hull.planes, face));
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

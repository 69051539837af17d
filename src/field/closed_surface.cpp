#include "field/closed_surface.h"

#include "query/winding.h"

namespace contactscope {
namespace {

/// For each vertex the first one at the same place: many tools duplicate vertices.
std::vector<int> first_in_place(const Mesh<double>& mesh, const std::vector<MeshEdge>& edges) {
  struct Earlier {
    bool operator()(const Vec3d& a, const Vec3d& b) const {
      for (int axis = 0; axis < 3; ++axis)
        if (a[axis] != b[axis]) return a[axis] < b[axis];
      return false;
    }
  };
  std::vector<int> first(mesh.vertices.size(), -1);
  std::map<Vec3d, int, Earlier> places;
  for (const MeshEdge& edge : edges) {
    for (const int end : {edge.edge, (edge.edge + 1) % 3}) {
      const int vertex = at(at(mesh.triangles, edge.triangle), end);
      at(first, vertex) = places.emplace(at(mesh.vertices, vertex), vertex).first->second;
    }
  }
  return first;
}

/// For each edge, the number of triangles that run from its smaller vertex to its larger one, minus
/// those that run back. Only edges where it is not 0.
std::map<std::pair<int, int>, int> unmatched_edges(const Mesh<double>& mesh) {
  const std::vector<MeshEdge> open = open_edges(mesh);
  const std::vector<int> first = first_in_place(mesh, open);
  std::map<std::pair<int, int>, int> counts;
  for (const MeshEdge& edge : open) {
    const std::array<int, 3>& corners = at(mesh.triangles, edge.triangle);
    const int from = at(first, at(corners, edge.edge));
    const int to = at(first, at(corners, (edge.edge + 1) % 3));
    counts[std::minmax(from, to)] += from < to ? 1 : -1;
  }
  std::erase_if(counts, [](const auto& edge) { return edge.second == 0; });
  return counts;
}

/// Union-find of the vertices that edges join.
class Parts {
 public:
  int of(int vertex) {
    const auto [entry, fresh] = parent_.emplace(vertex, vertex);
    if (entry->second == vertex) return vertex;
    return entry->second = of(entry->second);
  }
  void join(int one, int other) { parent_[of(one)] = of(other); }

 private:
  std::map<int, int> parent_;
};

double area_of(const Mesh<double>& mesh, int first, int last) {
  double area = 0;
  for (int t = first; t < last; ++t) {
    const Vec3d& a = mesh.corner(t, 0);
    area += 0.5 * (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm();
  }
  return area;
}

/// Six times the volume inside the surface; parts that are inside out count negative.
double volume_of(const Mesh<double>& mesh) {
  const Vec3d origin = mesh.tree.bounds().center();
  double volume = 0;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    volume += (mesh.corner(t, 0) - origin)
                  .dot((mesh.corner(t, 1) - origin).cross(mesh.corner(t, 2) - origin));
  return volume;
}

}  // namespace

ClosedSurface close_surface(const Mesh<double>& mesh) {
  const auto edges = unmatched_edges(mesh);
  ClosedSurface closed{mesh, mesh.triangle_count(), 0};
  if (!edges.empty()) {
    Parts parts;
    for (const auto& [ends, count] : edges) parts.join(ends.first, ends.second);
    // Sums are relative to a point of the part: a mesh far from its origin loses nothing.
    struct Tip {
      Vec3d sum = Vec3d::Zero();
      int count = 0, vertex = -1;
    };
    std::map<int, Tip> tips;
    for (const auto& [ends, count] : edges) {
      const int part = parts.of(ends.first);
      Tip& tip = tips[part];
      for (const int end : {ends.first, ends.second})
        tip.sum += at(mesh.vertices, end) - at(mesh.vertices, part);
      tip.count += 2;
    }
    std::vector<Vec3d> vertices = mesh.vertices;
    std::vector<std::array<int, 3>> triangles = mesh.triangles;
    for (auto& [part, tip] : tips) {
      tip.vertex = count_of(vertices);
      vertices.emplace_back(at(mesh.vertices, part) + tip.sum / tip.count);
    }
    for (const auto& [ends, count] : edges) {
      const auto [low, high] = ends;
      const int tip = tips[parts.of(low)].vertex;
      for (int k = 0; k < std::abs(count); ++k)
        triangles.push_back(count > 0 ? std::array{high, low, tip} : std::array{low, high, tip});
    }
    closed.mesh = build_mesh(std::move(vertices), std::move(triangles));
    closed.cap_share = area_of(closed.mesh, closed.own_triangles, closed.mesh.triangle_count()) /
                       area_of(closed.mesh, 0, closed.own_triangles);
  }
  if (closed.cap_share > kLargestCapShare)
    throw ShapeError("the mesh has no inside: closing its holes takes " +
                     std::to_string(std::lround(100 * closed.cap_share)) +
                     " % of its area; give a mesh that encloses a volume");
  // A sheet folded onto itself leaves only rounding.
  const double size = closed.mesh.tree.bounds().extent().norm();
  if (std::abs(volume_of(closed.mesh)) <=
      0x1p-40 * size * area_of(closed.mesh, 0, closed.mesh.triangle_count()))
    throw ShapeError(
        "the mesh has no inside: its parts cancel, or it is a sheet; give a mesh that encloses a "
        "volume, with all fronts outside");
  return closed;
}

Mesh<double> surface_of(const Hull<double>& hull) {
  std::vector<std::array<int, 3>> triangles;
  for (int face = 0; face < hull.face_count(); ++face) {
    const std::vector<int> around = face_vertices(hull, face);
    const std::vector<Vec3d> corners =
        mapped(around, [&](int vertex) -> Vec3d { return at(hull.vertices, vertex); });
    for (const std::array<int, 3>& triangle : triangulate_polygon(corners))
      triangles.push_back(
          {at(around, triangle[0]), at(around, triangle[1]), at(around, triangle[2])});
  }
  return build_mesh(hull.vertices, std::move(triangles));
}

}  // namespace contactscope

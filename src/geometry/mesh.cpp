#include "geometry/mesh.h"

#include "geometry/mesh_seams.h"

namespace contactscope {
namespace {

// Rounding a triangle's coordinates, by at most half a unit of 2^-52 of the largest, moves its
// height over the longest edge by at most sqrt(3) units. At a height of 128 units its normal turns
// by less than 0.8 degrees; kFlatEdgeAngle is one degree.
constexpr double kMinHeight = 128 * std::numeric_limits<double>::epsilon();

// In lengths of the longest edge. Below it, the normal's error exceeds about 30 roundings.
constexpr double kSliverHeight = 1.0 / 16;

using Triangles = std::span<const std::array<int, 3>>;

void require_finite(const std::vector<Vec3d>& vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!vertices[i].allFinite())
      throw ShapeError("vertex " + std::to_string(i) +
                       " has a coordinate that is not a finite number; give three finite ones");
  if (!vertices.empty() && !box_around(vertices).extent().allFinite())
    throw ShapeError("the mesh is too large for its number type; scale it down to metres");
}

void require_vertices(Triangles triangles, int vertex_count) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const int vertex : triangles[i]) {
      if (vertex >= 0 && vertex < vertex_count) continue;
      throw ShapeError("triangle " + std::to_string(i) + " names vertex " + std::to_string(vertex) +
                       ", but there are " + std::to_string(vertex_count) + ", counted from 0");
    }
  }
}

struct Side {
  int low, high;  // welded vertices
  int triangle;
  int edge;
  bool upwards;  // from low to high

  auto operator<=>(const Side&) const = default;
};

/// For each vertex, the first one with equal coordinates (0 equals -0).
std::vector<int> weld(std::span<const Vec3d> vertices) {
  std::vector<int> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int i) {
    const Vec3d& vertex = at(vertices, i);
    return std::tuple(vertex.x(), vertex.y(), vertex.z(), i);
  });
  std::vector<int> first(vertices.size());
  int last = -1;
  for (const int i : order) {
    if (last < 0 || at(vertices, i) != at(vertices, last)) last = i;
    at(first, i) = last;
  }
  return first;
}

/// Sorted by edge, then by triangle.
std::vector<Side> sides_of(Triangles triangles, const std::vector<int>& welded) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (int t = 0; t < count_of(triangles); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = at(welded, at(at(triangles, t), k));
      const int to = at(welded, at(at(triangles, t), (k + 1) % 3));
      if (from != to) sides.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
    }
  }
  std::ranges::sort(sides);
  return sides;
}

/// Mesh::neighbours of these triangles. Edges that have none for a reason are reported; those of one
/// triangle alone are added to `alone`. O(n log n).
std::vector<std::array<int, 3>> find_neighbours(std::span<const Vec3d> vertices,
                                                Triangles triangles, MeshReport& report,
                                                std::vector<TriangleEdge>& alone) {
  std::vector<std::array<int, 3>> neighbours(triangles.size(), {-1, -1, -1});
  const std::vector<Side> sides = sides_of(triangles, weld(vertices));
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high) {
      ++end;
    }
    const std::span<const Side> shared = std::span(sides).subspan(begin, end - begin);
    if (shared.size() == 1) {
      alone.push_back({shared[0].triangle, shared[0].edge});
      continue;
    }
    // Two sides of one triangle without area.
    if (shared.size() == 2 && shared[0].triangle == shared[1].triangle) continue;
    if (shared.size() > 2) {
      report.non_manifold_edges.push_back(mapped(shared, &Side::triangle));
    } else if (shared[0].upwards == shared[1].upwards) {
      report.flipped_edges.push_back(mapped(shared, &Side::triangle));
    } else {
      at(at(neighbours, shared[0].triangle), shared[0].edge) = shared[1].triangle;
      at(at(neighbours, shared[1].triangle), shared[1].edge) = shared[0].triangle;
    }
  }
  return neighbours;
}

template <class S> Vec3d normal_of(const Mesh<S>& mesh, int triangle) {
  const auto corner = [&](int k) -> Vec3d {
    return mesh.corner(triangle, k).template cast<double>();
  };
  return triangle_normal(corner(0), corner(1), corner(2));
}

/// Marks the slivers. Squares of lengths below 1e-77 m vanish, and such triangles are no slivers.
template <class S> void find_slivers(Mesh<S>& mesh) {
  mesh.slivers.resize(mesh.triangles.size());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const auto edge = [&](int k) -> Vec3d {
      return (mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k)).template cast<double>();
    };
    const double least =
        kSliver * std::max({edge(0).squaredNorm(), edge(1).squaredNorm(), edge(2).squaredNorm()});
    at(mesh.slivers, t) = edge(0).cross(edge(1)).squaredNorm() < least * least ? 1 : 0;
  }
}

template <class S> AabbTree<S> new_tree(const Mesh<S>& mesh) {
  return aabb_tree_cast<S>(
      build_aabb_tree(mapped(mesh.triangles, [&](const std::array<int, 3>& triangle) {
        return box_of<S>(mesh.vertices, triangle).template cast<double>();
      })));
}

Mesh<double> build(std::vector<Vec3d> vertices, std::vector<std::array<int, 3>> triangles,
                   bool keeps_flat, MeshReport& found) {
  found = {};
  require_finite(vertices);
  require_vertices(triangles, count_of(vertices));

  Mesh<double> mesh;
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
  std::size_t kept = 0;
  for (int i = 0; i < mesh.triangle_count(); ++i) {
    const Vec3d normal = normal_of(mesh, i);
    if (!keeps_flat && normal.isZero(0)) {
      found.zero_area_triangles.push_back(i);
      continue;
    }
    mesh.normals.push_back(normal);
    mesh.triangles[kept++] = at(mesh.triangles, i);
  }
  if (kept == 0)
    throw ShapeError(mesh.triangles.empty()
                         ? "the mesh has no triangle; give at least one"
                         : "every triangle of the mesh has zero area; give one whose corners are "
                           "not on a line");
  mesh.triangles.resize(kept);
  std::vector<TriangleEdge> alone;
  mesh.neighbours = find_neighbours(mesh.vertices, mesh.triangles, found, alone);
  mesh.seams = find_seams(mesh, alone);
  classify_edges(mesh);
  find_slivers(mesh);
  mesh.tree = new_tree(mesh);
  return mesh;
}

}  // namespace

Vec3d triangle_normal(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double largest =
      std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
  const std::array<Vec3d, 3> edges{b - a, c - b, a - c};
  const Vec3d lengths(edges[0].stableNorm(), edges[1].stableNorm(), edges[2].stableNorm());
  std::size_t longest = 0;
  const double length = lengths.maxCoeff(&longest);
  if (!(length > 0)) return Vec3d::Zero();
  // The two other edges: the rounding error grows with the product of their lengths, but the area
  // does not. A common scale avoids under- and overflow of squares.
  const Vec3d before = edges[(longest + 1) % 3] / length;
  const Vec3d after = edges[(longest + 2) % 3] / length;
  Vec3d normal = before.cross(after);
  const double height = normal.norm();  // over the longest edge, in lengths of that edge
  if (!(height * length > kMinHeight * largest)) return Vec3d::Zero();
  normal /= height;
  // A sliver's normal leans by a rounding over its height, also along the edge: a plane through one
  // end would miss the other. Make it perpendicular to the edge again.
  if (height < kSliverHeight) {
    const Vec3d along = edges[longest] / length;
    normal = (normal - normal.dot(along) * along).normalized();
  }
  return normal;
}

/// Angle between the normals about the edge. Its sine is the triple product of both normals and the
/// edge, positive if the surface bends away from the front; its cosine is their dot product.
template <class S> double bend_angle(const Mesh<S>& mesh, int triangle, int edge) {
  const int beyond = mesh.beyond(triangle, edge);
  assert(beyond >= 0);
  const Vec3d here = mesh.normal(triangle).template cast<double>();
  const Vec3d there = mesh.normal(beyond).template cast<double>();
  const Vec3d along = mesh.corner(triangle, (edge + 1) % 3).template cast<double>() -
                      mesh.corner(triangle, edge).template cast<double>();
  const double sine = here.cross(there).dot(along.stableNormalized());
  const double cosine = here.dot(there);
  const double angle = std::atan2(sine, cosine);
  // A sheet folded onto itself: rounding may decide the sign. As convex, the edge can be touched.
  return angle < kFlatEdgeAngle - std::numbers::pi ? angle + 2 * std::numbers::pi : angle;
}

/// A region is a tree of triangles whose parents have lower numbers.
template <class S> void classify_edges(Mesh<S>& mesh) {
  using enum EdgeClass;
  mesh.edges.assign(mesh.triangles.size(), {Boundary, Boundary, Boundary});
  mesh.regions.resize(mesh.normals.size());
  std::iota(mesh.regions.begin(), mesh.regions.end(), 0);
  const auto root = [&](int triangle) {
    while (mesh.region(triangle) != triangle)
      triangle = at(mesh.regions, triangle) = mesh.region(mesh.region(triangle));
    return triangle;
  };
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.beyond(t, k) < 0) continue;
      const double bend = bend_angle(mesh, t, k);
      at(at(mesh.edges, t), k) = bend > kFlatEdgeAngle ? Convex : Internal;
      if (std::abs(bend) > kFlatEdgeAngle || mesh.beyond(t, k) >= mesh.triangle_count()) continue;
      const int here = root(t), there = root(mesh.beyond(t, k));
      at(mesh.regions, std::max(here, there)) = std::min(here, there);
    }
  }
  for (int t = 0; t < mesh.triangle_count(); ++t) at(mesh.regions, t) = root(t);
}

Mesh<double> build_mesh(std::vector<Vec3d> vertices, std::vector<std::array<int, 3>> triangles,
                        MeshReport* report) {
  MeshReport ignored;
  return build(std::move(vertices), std::move(triangles), false,
               report != nullptr ? *report : ignored);
}

Mesh<double> build_mesh_with_flat_triangles(std::vector<Vec3d> vertices,
                                            std::vector<std::array<int, 3>> triangles,
                                            MeshReport* report) {
  MeshReport ignored;
  return build(std::move(vertices), std::move(triangles), true,
               report != nullptr ? *report : ignored);
}

template <class T> Mesh<T> mesh_cast(const Mesh<double>& mesh) {
  Mesh<T> cast;
  cast.vertices = cast_each<Vec3<T>>(mesh.vertices);
  cast.triangles = mesh.triangles;
  cast.neighbours = mesh.neighbours;
  cast.seams = mesh.seams;
  cast.seam = mesh.seam;
  cast.edges = mesh.edges;
  cast.regions = mesh.regions;
  cast.normals.reserve(mesh.normals.size());
  for (int i = 0; i < mesh.triangle_count(); ++i) {
    const Vec3d normal = normal_of(cast, i);
    const bool turned_over = normal.dot(mesh.normal(i)) < 0;
    cast.normals.push_back((turned_over ? mesh.normal(i) : normal).template cast<T>());
  }
  for (std::size_t i = mesh.triangles.size(); i < mesh.normals.size(); ++i)
    cast.normals.push_back(mesh.normals[i].template cast<T>());
  find_slivers(cast);
  cast.tree = aabb_tree_cast<T>(mesh.tree);
  return cast;
}

template <class S> void update_surface(Mesh<S>& mesh) {
  for (int i = 0; i < mesh.triangle_count(); ++i)
    at(mesh.normals, i) = normal_of(mesh, i).template cast<S>();
  if (!mesh.seams.empty()) {
    std::vector<TriangleEdge> on_seams;
    for (int t = 0; t < mesh.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k)
        if (at(at(mesh.seams, t), k) >= 0) on_seams.push_back({t, k});
    mesh.seams = find_seams(mesh, on_seams);
  }
  classify_edges(mesh);
  find_slivers(mesh);
}

template <class S> void refit(Mesh<S>& mesh) {
  update_surface(mesh);
  mesh.tree.refit(mesh.vertices, mesh.triangles);
}

template <class S> bool update_tree(Mesh<S>& mesh, TreeUpdate how, double& cost_when_built) {
  if (how != TreeUpdate::Rebuild) {
    mesh.tree.refit(mesh.vertices, mesh.triangles);
    if (how == TreeUpdate::Refit) return false;
    if (mesh.tree.expected_cost() <= kWorstTreeCost * cost_when_built) return false;
  }
  mesh.tree = new_tree(mesh);
  cost_when_built = mesh.tree.expected_cost();
  return true;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(classify_edges);
CONTACTSCOPE_FLOAT_AND_DOUBLE(bend_angle, mesh_cast, update_surface, refit, update_tree);

}  // namespace contactscope

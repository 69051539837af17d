#include "geometry/mesh_adjacency.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace contactscope {
namespace {

/// One side of an edge: the triangle that it belongs to runs from `from` to `to`.
struct Side {
  int low, high;  // welded vertices
  bool upwards;   // from low to high
  int triangle;
  int edge;
};

/// For each vertex the first one with the same coordinates (0 and -0 are).
std::vector<int> weld(std::span<const Vec3d> vertices) {
  const auto vertex = [&](int i) -> const Vec3d& { return vertices[static_cast<std::size_t>(i)]; };
  std::vector<int> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int one, int other) {
    const Vec3d& a = vertex(one);
    const Vec3d& b = vertex(other);
    return std::tuple(a.x(), a.y(), a.z(), one) < std::tuple(b.x(), b.y(), b.z(), other);
  });
  std::vector<int> first(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && vertex(order[i]) == vertex(order[i - 1]);
    first[static_cast<std::size_t>(order[i])] =
        same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return first;
}

std::vector<Side> sides_of(std::span<const std::array<int, 3>> triangles,
                           const std::vector<int>& welded) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = welded[static_cast<std::size_t>(triangles[t][k])];
      const int to = welded[static_cast<std::size_t>(triangles[t][(k + 1) % 3])];
      sides.push_back({std::min(from, to), std::max(from, to), from < to, static_cast<int>(t),
                       static_cast<int>(k)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle, a.edge) <
           std::tie(b.low, b.high, b.triangle, b.edge);
  });
  return sides;
}

MeshReport::Edge reported(std::span<const Side> sides,
                          std::span<const std::array<int, 3>> triangles) {
  const std::array<int, 3>& first = triangles[static_cast<std::size_t>(sides[0].triangle)];
  const std::size_t k = static_cast<std::size_t>(sides[0].edge);
  MeshReport::Edge edge{{first[k], first[(k + 1) % 3]}, {}};
  for (const Side& side : sides) edge.triangles.push_back(side.triangle);
  return edge;
}

}  // namespace

std::vector<std::array<int, 3>> find_neighbours(std::span<const Vec3d> vertices,
                                                std::span<const std::array<int, 3>> triangles,
                                                MeshReport& report) {
  std::vector<std::array<int, 3>> neighbours(triangles.size(), {-1, -1, -1});
  const auto set = [&](const Side& side, int neighbour) {
    neighbours[static_cast<std::size_t>(side.triangle)][static_cast<std::size_t>(side.edge)] =
        neighbour;
  };
  const std::vector<Side> sides = sides_of(triangles, weld(vertices));
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high) {
      ++end;
    }
    const std::span<const Side> shared = std::span(sides).subspan(begin, end - begin);
    if (shared.size() == 1) continue;
    if (shared.size() > 2) {
      report.non_manifold_edges.push_back(reported(shared, triangles));
    } else if (shared[0].upwards == shared[1].upwards) {
      report.flipped_edges.push_back(reported(shared, triangles));
    } else {
      set(shared[0], shared[1].triangle);
      set(shared[1], shared[0].triangle);
    }
  }
  return neighbours;
}

/// The angle from one normal to the other about the edge: its sine is the triple product of both
/// and the edge, positive where the surface bends away from the front, its cosine their product.
template <class S>
double bend_angle(const Mesh<S>& mesh, int triangle, int edge) {
  const int neighbour = mesh.neighbour(triangle, edge);
  assert(neighbour >= 0);
  const Vec3d here = mesh.normal(triangle).template cast<double>();
  const Vec3d there = mesh.normal(neighbour).template cast<double>();
  const Vec3d along = mesh.corner(triangle, (edge + 1) % 3).template cast<double>() -
                      mesh.corner(triangle, edge).template cast<double>();
  const double sine = here.cross(there).dot(along.stableNormalized());
  const double cosine = here.dot(there);
  const double angle = std::atan2(sine, cosine);
  // A sheet folded onto itself: rounding alone may say which way. It is an edge that can be
  // touched; a crease so sharp cannot.
  return angle < kFlatEdgeAngle - std::numbers::pi ? angle + 2 * std::numbers::pi : angle;
}

template <class S>
std::vector<std::array<EdgeClass, 3>> classify_edges(const Mesh<S>& mesh) {
  std::vector<std::array<EdgeClass, 3>> classes(mesh.triangles.size());
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      EdgeClass& edge = classes[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)];
      if (mesh.neighbour(t, k) < 0) {
        edge = EdgeClass::Boundary;
      } else {
        edge = bend_angle(mesh, t, k) > kFlatEdgeAngle ? EdgeClass::Convex : EdgeClass::Internal;
      }
    }
  }
  return classes;
}

template double bend_angle(const Mesh<float>&, int, int);
template double bend_angle(const Mesh<double>&, int, int);
template std::vector<std::array<EdgeClass, 3>> classify_edges(const Mesh<float>&);
template std::vector<std::array<EdgeClass, 3>> classify_edges(const Mesh<double>&);

}  // namespace contactscope

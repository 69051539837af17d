#include "geometry/mesh_seams.h"

#include <algorithm>

#include "core/at.h"
#include "core/instantiate.h"

namespace contactscope {
namespace {

template <class S> SurfaceEdge edge_of(const Mesh<S>& mesh, const TriangleEdge& edge) {
  const auto corner = [&](int k) -> Vec3d {
    return mesh.corner(edge.triangle, k % 3).template cast<double>();
  };
  return {corner(edge.edge), corner(edge.edge + 1) - corner(edge.edge),
          mesh.normal(edge.triangle).template cast<double>()};
}

Aabb<double> box_of(const SurfaceEdge& edge, double margin) {
  const Vec3d to = edge.from + edge.along, grown = Vec3d::Constant(margin);
  return {edge.from.cwiseMin(to) - grown, edge.from.cwiseMax(to) + grown};
}

/// The part of an edge along which another one lies, in metres from the edge's start.
struct Part {
  double begin, end;
  int other;
};

/// Step 2. Empty if the other edge is not on this one.
Part part_along(const SurfaceEdge& edge, const SurfaceEdge& other, int number, double width) {
  const double length = edge.along.norm();
  const Vec3d direction = edge.along / length;
  const auto place = [&](const Vec3d& point) { return (point - edge.from).dot(direction); };
  const double first = place(other.from + other.along), last = place(other.from);
  if (!(last > first)) return {};
  const Part part{std::max(first, 0.0), std::min(last, length), number};
  for (const double end : {part.begin, part.end}) {
    const Vec3d there = other.from + (last - end) / (last - first) * other.along;
    if (!((there - edge.from - end * direction).norm() <= width)) return {};
  }
  return part;
}

/// Whether parts cover an edge of this length.
bool leave_no_gap(std::vector<Part> parts, double length, double width) {
  std::ranges::sort(parts, {}, &Part::begin);
  double covered = 0;
  for (const Part& part : parts) {
    if (part.begin > covered + width) return false;
    covered = std::max(covered, part.end);
  }
  return covered >= length - width;
}

}  // namespace

double seam_width(const SurfaceEdge& edge, double widest) {
  return std::min(widest, kSliver * edge.along.norm());
}

template <class S> double widest_seam(const Mesh<S>& mesh, const std::vector<TriangleEdge>& edges) {
  double reach = 0;
  for (const TriangleEdge& edge : edges)
    reach = std::max(reach, edge_of(mesh, edge).from.cwiseAbs().maxCoeff());
  return mesh.seam * reach;
}

int continuation(const SurfaceEdge& edge, const std::vector<SurfaceEdge>& near, double width) {
  std::vector<Part> parts;
  for (int i = 0; i < count_of(near); ++i) {
    const Part part = part_along(edge, at(near, i), i, width);
    if (part.end - part.begin > width) parts.push_back(part);
  }
  if (parts.empty() || !leave_no_gap(parts, edge.along.norm(), width)) return -1;
  const auto normal = [&](const Part& part) -> const Vec3d& { return at(near, part.other).normal; };
  for (const Part& part : parts)
    if (!((normal(part) - normal(parts.front())).norm() <= kFlatEdgeAngle)) return -1;
  return std::ranges::max_element(parts, {}, [](const Part& part) { return part.end - part.begin; })
      ->other;
}

template <class S>
std::vector<SurfaceEdge> edges_of_wide_triangles(const Mesh<S>& mesh,
                                                 std::vector<TriangleEdge>& edges) {
  const double seam = widest_seam(mesh, edges);
  std::erase_if(edges, [&](const TriangleEdge& edge) {
    const Vec3d along = edge_of(mesh, edge).along;
    const Vec3d next = edge_of(mesh, {edge.triangle, edge.edge + 1}).along;
    return !has_area(mesh, edge.triangle) || !(along.cross(next).norm() > 2 * seam * along.norm());
  });
  return mapped(edges, [&](const TriangleEdge& edge) { return edge_of(mesh, edge); });
}

template <class S>
std::vector<std::array<int, 3>> find_seams(const Mesh<S>& mesh, std::vector<TriangleEdge> alone,
                                           const std::vector<SurfaceEdge>& others) {
  std::vector<std::array<int, 3>> seams;
  const double widest = widest_seam(mesh, alone);
  std::vector<SurfaceEdge> edges = edges_of_wide_triangles(mesh, alone);
  edges.insert(edges.end(), others.begin(), others.end());
  if (edges.size() < 2) return seams;
  const auto boxes = mapped(edges, [&](const SurfaceEdge& edge) { return box_of(edge, widest); });
  const auto triangle_of = [&](int edge) {
    const int other = edge - count_of(alone);
    return other < 0 ? at(alone, edge).triangle : mesh.triangle_count() + other;
  };
  const AabbTree<double> tree = build_aabb_tree(boxes);
  std::vector<int> found;
  std::vector<SurfaceEdge> near;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    found.clear();
    near.clear();
    tree.query(boxes[i], [&](int other) {
      if (triangle_of(other) == alone[i].triangle) return;
      found.push_back(triangle_of(other));
      near.push_back(at(edges, other));
    });
    const int beyond = continuation(edges[i], near, seam_width(edges[i], widest));
    if (beyond < 0) continue;
    if (seams.empty()) seams.resize(mesh.triangles.size(), {-1, -1, -1});
    at(at(seams, alone[i].triangle), alone[i].edge) = at(found, beyond);
  }
  return seams;
}

std::vector<TriangleEdge> lone_edges(const Mesh<double>& mesh) {
  std::vector<TriangleEdge> lone;
  for (int t = 0; t < mesh.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k)
      if (mesh.beyond(t, k) < 0) lone.push_back({t, k});
  return lone;
}

void weld(Mesh<double>& mesh, double seam) {
  mesh.seam = seam;
  mesh.seams.clear();
  mesh.seams = find_seams(mesh, lone_edges(mesh));
  classify_edges(mesh);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(widest_seam);
CONTACTSCOPE_FLOAT_AND_DOUBLE(edges_of_wide_triangles, find_seams);

}  // namespace contactscope

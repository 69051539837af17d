#include "geometry/mesh_seams.h"

#include <algorithm>

#include "core/at.h"
#include "core/instantiate.h"

namespace contactscope {
namespace {

struct Line {
  Vec3d from, along;  // metres
};

template <class S> Line line_of(const Mesh<S>& mesh, const TriangleEdge& edge) {
  const auto corner = [&](int k) -> Vec3d {
    return mesh.corner(edge.triangle, k % 3).template cast<double>();
  };
  return {corner(edge.edge), corner(edge.edge + 1) - corner(edge.edge)};
}

/// The part of an edge along which another triangle lies, in metres from the edge's start.
struct Part {
  double begin, end;
  int triangle;
};

/// Step 2. Empty if the other edge is not on this one.
Part part_along(const Line& edge, const Line& other, int triangle, double width) {
  const double length = edge.along.norm();
  const Vec3d direction = edge.along / length;
  const auto place = [&](const Vec3d& point) { return (point - edge.from).dot(direction); };
  const double first = place(other.from + other.along), last = place(other.from);
  if (!(last > first)) return {};
  const Part part{std::max(first, 0.0), std::min(last, length), triangle};
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

template <class S> bool bend_equally(const Mesh<S>& mesh, const std::vector<Part>& parts) {
  const Vec3<S>& first = mesh.normal(parts.front().triangle);
  return std::ranges::all_of(parts, [&](const Part& part) {
    return (mesh.normal(part.triangle) - first).norm() <= static_cast<S>(kFlatEdgeAngle);
  });
}

/// Of these edges those whose triangle is wider than a seam: the sides of a strip as narrow as one
/// would be a seam of it with itself.
template <class S>
std::vector<TriangleEdge> of_wide_triangles(const Mesh<S>& mesh, std::vector<TriangleEdge> edges,
                                            double seam) {
  std::erase_if(edges, [&](const TriangleEdge& edge) {
    const Line line = line_of(mesh, edge);
    const Line next = line_of(mesh, {edge.triangle, edge.edge + 1});
    return !has_area(mesh, edge.triangle) ||
           !(line.along.cross(next.along).norm() > 2 * seam * line.along.norm());
  });
  return edges;
}

}  // namespace

template <class S>
std::vector<std::array<int, 3>> find_seams(const Mesh<S>& mesh,
                                           const std::vector<TriangleEdge>& alone) {
  double reach = 0;
  for (const TriangleEdge& edge : alone)
    reach = std::max(reach, line_of(mesh, edge).from.cwiseAbs().maxCoeff());
  std::vector<std::array<int, 3>> seams;
  const std::vector<TriangleEdge> edges = of_wide_triangles(mesh, alone, kSeam * reach);
  if (edges.size() < 2) return seams;
  const std::vector<Line> lines =
      mapped(edges, [&](const TriangleEdge& edge) { return line_of(mesh, edge); });
  const Vec3d margin = Vec3d::Constant(kSeam * reach);
  const auto boxes = mapped(lines, [&](const Line& line) -> Aabb<double> {
    const Vec3d to = line.from + line.along;
    return {line.from.cwiseMin(to) - margin, line.from.cwiseMax(to) + margin};
  });
  const AabbTree<double> tree = build_aabb_tree(boxes);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const int triangle = edges[i].triangle;
    const double length = lines[i].along.norm();
    // Edges that are hardly longer than a seam may lie next to each other by chance.
    const double width = std::min(kSeam * reach, kSliver * length);
    std::vector<Part> parts;
    tree.query(boxes[i], [&](int other) {
      const int beyond = at(edges, other).triangle;
      if (beyond == triangle) return;
      const Part part = part_along(lines[i], at(lines, other), beyond, width);
      if (part.end - part.begin > width) parts.push_back(part);
    });
    if (parts.empty() || !leave_no_gap(parts, length, width) || !bend_equally(mesh, parts))
      continue;
    if (seams.empty()) seams.resize(mesh.triangles.size(), {-1, -1, -1});
    const auto longest =
        std::ranges::max_element(parts, {}, [](const Part& part) { return part.end - part.begin; });
    at(at(seams, triangle), edges[i].edge) = longest->triangle;
  }
  return seams;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(find_seams);

}  // namespace contactscope

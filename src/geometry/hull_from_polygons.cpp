#include "geometry/hull_builder.h"

#include <unordered_map>

#include "core/manifold.h"
#include "geometry/predicates.h"

namespace contactscope {
namespace {

[[noreturn]] void not_closed(const std::string& what) {
  throw ShapeError(what + "; the faces of a hull bound one solid, each edge between two of them");
}

void check_face(int face, const std::vector<int>& vertices, int vertex_count) {
  const std::string name = "face " + std::to_string(face);
  const std::size_t count = vertices.size();
  if (count < 3) not_closed(name + " has fewer than three vertices");
  if (count > kMaxFaceVertices)
    throw ShapeError("a face has " + std::to_string(count) +
                     " vertices; a hull's face has at most " + std::to_string(kMaxFaceVertices) +
                     "; give a coarser outline");
  for (std::size_t i = 0; i < count; ++i) {
    if (vertices[i] < 0 || vertices[i] >= vertex_count)
      not_closed(name + " names a vertex that does not exist");
    if (vertices[i] == vertices[(i + 1) % count]) not_closed(name + " repeats a vertex");
  }
}

/// Numbers the edges and links each half-edge to its twin (by index) and its successor.
void link_edges(Hull<double>& hull, const std::vector<std::vector<int>>& faces) {
  std::unordered_map<std::uint64_t, int> half_edge_of;
  half_edge_of.reserve(6 * faces.size());
  const auto key = [](int origin, int target) {
    return static_cast<std::uint64_t>(origin) << 32 | static_cast<std::uint32_t>(target);
  };
  for (int face = 0; face < count_of(faces); ++face) {
    const std::vector<int>& vertices = at(faces, face);
    check_face(face, vertices, hull.vertex_count());
    int previous = -1;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const int origin = vertices[i], target = vertices[(i + 1) % vertices.size()];
      const int fresh = count_of(hull.half_edges);
      const auto [place, is_new] = half_edge_of.try_emplace(key(origin, target), fresh);
      const int half_edge = place->second;
      if (is_new) {
        half_edge_of.emplace(key(target, origin), fresh + 1);
        hull.half_edges.push_back({origin, -1, -1});
        hull.half_edges.push_back({target, -1, -1});
      }
      if (at(hull.half_edges, half_edge).face >= 0)
        not_closed("the edge from vertex " + std::to_string(origin) + " to " +
                   std::to_string(target) + " is in two faces in the same direction");
      at(hull.half_edges, half_edge).face = face;
      if (i == 0) hull.face_edges.push_back(half_edge);
      if (i > 0) at(hull.half_edges, previous).next = half_edge;
      previous = half_edge;
    }
    at(hull.half_edges, previous).next = hull.face_edges.back();
  }
  hull.vertex_edges.assign(hull.vertices.size(), -1);
  for (int i = count_of(hull.half_edges); i-- > 0;)
    at(hull.vertex_edges, at(hull.half_edges, i).origin) = i;
}

void check_closed(const Hull<double>& hull) {
  for (const HalfEdge& edge : hull.half_edges)
    if (edge.face < 0)
      not_closed("an edge at vertex " + std::to_string(edge.origin) + " has one face");
  for (std::size_t i = 0; i < hull.vertex_edges.size(); ++i)
    if (hull.vertex_edges[i] < 0) not_closed("vertex " + std::to_string(i) + " is in no face");
  const int euler = hull.vertex_count() - hull.edge_count() + hull.face_count();
  if (euler != 2)
    not_closed("V - E + F is " + std::to_string(euler) + ", but 2 for a convex solid");
}

Vec3d mean_of(const std::vector<Vec3d>& points) {
  // Relative to the first point, so that a far origin costs no digits.
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& point : points) sum += point - points[0];
  return points[0] + sum / static_cast<double>(points.size());
}

double largest_offset(const std::vector<Vec3d>& points, const Vec3d& from) {
  double largest = 0;
  for (const Vec3d& point : points) {
    const Vec3d offset = point - from;
    largest = std::max(largest, offset.cwiseAbs().maxCoeff());
  }
  return largest;
}

/// Corners of a face relative to `middle`, in units of `scale`.
std::vector<Vec3d> corners_about(const Hull<double>& hull, int face, const Vec3d& middle,
                                 double scale) {
  return mapped(face_vertices(hull, face),
                [&](int vertex) -> Vec3d { return (at(hull.vertices, vertex) - middle) / scale; });
}

/// Centre of mass: mean of the tetrahedra between an inner point and a fan of each face, weighted
/// by volume, scaled by the solid's size, so that no product of lengths leaves the range of double.
Vec3d centroid_by_volume(const Hull<double>& hull) {
  const Vec3d inside = mean_of(hull.vertices);
  const double scale = largest_offset(hull.vertices, inside);
  double volume = 0;
  Vec3d moment = Vec3d::Zero();
  for (int face = 0; face < hull.face_count(); ++face) {
    const std::vector<Vec3d> corners = corners_about(hull, face, inside, scale);
    const Vec3d& a = corners[0];
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const Vec3d &b = corners[i - 1], &c = corners[i];
      const double tetrahedron = a.dot(b.cross(c));  // six times the volume
      volume += tetrahedron;
      moment += tetrahedron * 0.25 * (a + b + c);  // the fourth corner is the origin
    }
  }
  return inside + scale / volume * moment;
}

/// Centre of mass of a flat hull, weighted by area.
Vec3d centroid_by_area(const Hull<double>& hull) {
  const Vec3d& normal = hull.planes[0].normal;
  const Vec3d& first = hull.origin(hull.face_edges[0]);
  const double scale = largest_offset(hull.vertices, first);
  const std::vector<Vec3d> corners = corners_about(hull, 0, first, scale);
  double area = 0;
  Vec3d moment = Vec3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3d &b = corners[i - 1], &c = corners[i];
    const double triangle = normal.dot(b.cross(c));  // twice the area
    area += triangle;
    moment += triangle / 3 * (b + c);  // the third corner is the origin
  }
  return first + scale / area * moment;
}

/// Plane through the mean of a polygon's vertices in order, not all on one line; unit normal.
Plane<double> newell_plane(const std::vector<Vec3d>& vertices) {
  const Vec3d mean = mean_of(vertices);
  const int exponent = std::ilogb(largest_offset(vertices, mean));
  const Vec3d area = doubled_area(count_of(vertices), [&](int i) -> Vec3d {
    return at(vertices, i).unaryExpr([&](double x) { return std::ldexp(x, -exponent); });
  });
  const Vec3d normal = area / area.norm();
  return {normal, normal.dot(mean)};
}

}  // namespace

Hull<double> hull_from_polygons(std::vector<Vec3d> vertices,
                                const std::vector<std::vector<int>>& faces) {
  Hull<double> hull;
  hull.vertices = std::move(vertices);
  link_edges(hull, faces);
  hull.planes = mapped(faces, [&](const std::vector<int>& face) {
    return newell_plane(mapped(face, [&](int vertex) { return at(hull.vertices, vertex); }));
  });
  check_closed(hull);
  if (hull.flat()) hull.planes[1] = {-hull.planes[0].normal, -hull.planes[0].offset};

  hull.centroid = hull.flat() ? centroid_by_area(hull) : centroid_by_volume(hull);
  for (const Vec3d& vertex : hull.vertices) {
    const Vec3d arm = vertex - hull.centroid;
    hull.radius = std::max(hull.radius, arm.stableNorm());
  }
  lay_out(hull);
  return hull;
}

}  // namespace contactscope

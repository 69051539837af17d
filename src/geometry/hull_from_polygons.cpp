#include "geometry/hull_from_polygons.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/manifold.h"

namespace contactscope {
namespace {

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

[[noreturn]] void not_closed(const std::string& what) {
  throw HullError(HullProblem::NotClosed,
                  what + "; the faces of a hull bound one solid, each edge between two of them");
}

/// Numbers the edges and links each half-edge to its twin (by index) and to the next of its face.
class EdgeLinker {
 public:
  EdgeLinker(Hull<double>& hull, std::size_t face_count) : hull_(hull) {
    half_edge_of_.reserve(6 * face_count);
  }

  void add_face(int face, const std::vector<int>& vertices) {
    const std::size_t count = vertices.size();
    if (count < 3) not_closed("face " + std::to_string(face) + " has fewer than three vertices");
    if (count > kMaxFaceVertices) {
      throw HullError(HullProblem::FaceTooLarge, "a face has " + std::to_string(count) +
                                                     " vertices; a hull's face has at most " +
                                                     std::to_string(kMaxFaceVertices) +
                                                     "; give a coarser outline");
    }
    int previous = -1;
    int first = -1;
    for (std::size_t i = 0; i < count; ++i) {
      const int half_edge = claim(vertices[i], vertices[(i + 1) % count], face);
      if (i == 0) first = half_edge;
      if (previous >= 0) hull_.half_edges[index(previous)].next = half_edge;
      previous = half_edge;
    }
    hull_.half_edges[index(previous)].next = first;
    hull_.face_edges.push_back(first);
  }

 private:
  static std::uint64_t key(int origin, int target) {
    return static_cast<std::uint64_t>(origin) << 32 | static_cast<std::uint32_t>(target);
  }

  /// The half-edge from origin to target, made with its twin when neither is there yet.
  int claim(int origin, int target, int face) {
    if (std::min(origin, target) < 0 || std::max(origin, target) >= hull_.vertex_count()) {
      not_closed("face " + std::to_string(face) + " names a vertex that does not exist");
    }
    if (origin == target) not_closed("face " + std::to_string(face) + " repeats a vertex");
    const int fresh = static_cast<int>(hull_.half_edges.size());
    const auto [place, is_new] = half_edge_of_.try_emplace(key(origin, target), fresh);
    const int half_edge = place->second;
    if (is_new) {
      half_edge_of_.emplace(key(target, origin), fresh + 1);
      hull_.half_edges.push_back({origin, -1, -1});
      hull_.half_edges.push_back({target, -1, -1});
    }
    HalfEdge& edge = hull_.half_edges[index(half_edge)];
    if (edge.face >= 0) {
      not_closed("the edge from vertex " + std::to_string(origin) + " to " +
                 std::to_string(target) + " is in two faces in the same direction");
    }
    edge.face = face;
    return half_edge;
  }

  Hull<double>& hull_;
  std::unordered_map<std::uint64_t, int> half_edge_of_;
};

void check_closed(const Hull<double>& hull) {
  for (const HalfEdge& edge : hull.half_edges) {
    if (edge.face < 0)
      not_closed("an edge at vertex " + std::to_string(edge.origin) + " has one face");
  }
  for (std::size_t i = 0; i < hull.vertex_edges.size(); ++i) {
    if (hull.vertex_edges[i] < 0) not_closed("vertex " + std::to_string(i) + " is in no face");
  }
  const int euler = hull.vertex_count() - hull.edge_count() + hull.face_count();
  if (euler != 2) {
    not_closed("V - E + F is " + std::to_string(euler) + " where a convex solid has 2");
  }
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

/// Centre of mass at uniform density: the mean of the tetrahedra that a point inside makes with a
/// fan of each face, weighted by volume. In units of the solid's own size, so that no product of
/// lengths leaves the range of double.
Vec3d centroid_by_volume(const Hull<double>& hull) {
  const Vec3d inside = mean_of(hull.vertices);
  const double scale = largest_offset(hull.vertices, inside);
  const auto local = [&](int vertex) -> Vec3d {
    return (hull.vertices[index(vertex)] - inside) / scale;
  };
  double volume = 0;
  Vec3d moment = Vec3d::Zero();
  for (int face = 0; face < hull.face_count(); ++face) {
    const std::vector<int> corners = face_vertices(hull, face);
    const Vec3d a = local(corners[0]);
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const Vec3d b = local(corners[i - 1]);
      const Vec3d c = local(corners[i]);
      const double tetrahedron = a.dot(b.cross(c));  // six times its volume
      volume += tetrahedron;
      moment += tetrahedron * 0.25 * (a + b + c);  // its fourth corner is the origin
    }
  }
  return inside + scale / volume * moment;
}

/// The same of a flat hull, by area.
Vec3d centroid_by_area(const Hull<double>& hull) {
  const Vec3d& normal = hull.planes[0].normal;
  const std::vector<int> corners = face_vertices(hull, 0);
  const Vec3d& first = hull.vertices[index(corners[0])];
  const double scale = largest_offset(hull.vertices, first);
  double area = 0;
  Vec3d moment = Vec3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec3d b = (hull.vertices[index(corners[i - 1])] - first) / scale;
    const Vec3d c = (hull.vertices[index(corners[i])] - first) / scale;
    const double triangle = normal.dot(b.cross(c));  // twice its area
    area += triangle;
    moment += triangle / 3 * (b + c);  // its third corner is the origin
  }
  return first + scale / area * moment;
}

}  // namespace

Plane<double> newell_plane(const std::vector<Vec3d>& vertices) {
  // Newell's method sums what every edge adds to the area vector, so that no three corners, perhaps
  // nearly on a line, decide alone. Coordinates about the mean and in units of the polygon's size
  // keep the products accurate far from the origin and at every scale.
  const Vec3d mean = mean_of(vertices);
  const double scale = largest_offset(vertices, mean);
  Vec3d area = Vec3d::Zero();
  Vec3d from = (vertices.back() - mean) / scale;
  for (const Vec3d& vertex : vertices) {
    const Vec3d to = (vertex - mean) / scale;
    area += from.cross(to);
    from = to;
  }
  const Vec3d normal = area / area.norm();
  return {normal, normal.dot(mean)};
}

Hull<double> hull_from_polygons(std::vector<Vec3d> vertices,
                                const std::vector<std::vector<int>>& faces) {
  Hull<double> hull;
  hull.vertices = std::move(vertices);

  EdgeLinker linker(hull, faces.size());
  for (std::size_t face = 0; face < faces.size(); ++face) {
    linker.add_face(static_cast<int>(face), faces[face]);
  }
  hull.vertex_edges.assign(hull.vertices.size(), -1);
  for (std::size_t i = hull.half_edges.size(); i-- > 0;) {
    hull.vertex_edges[index(hull.half_edges[i].origin)] = static_cast<int>(i);
  }

  hull.planes.reserve(faces.size());
  std::vector<Vec3d> corners;
  for (const std::vector<int>& face : faces) {
    corners.clear();
    for (const int vertex : face) corners.push_back(hull.vertices[index(vertex)]);
    hull.planes.push_back(newell_plane(corners));
  }
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

#include "trace/outline.h"

#include <algorithm>
#include <limits>

#include "core/plane.h"

namespace contactscope::trace {
namespace {

// Vertices this close to a support plane, relative to the shape's size, are on it.
constexpr double kFlat = 1e-4;

/// Outward unit normal of a face of a shape, in the shape's frame.
Vec3d normal_of(const Shape& shape, const std::vector<int>& face) {
  const std::vector<Vec3d> corners =
      mapped(face, [&](int vertex) { return at(shape.vertices, vertex); });
  return newell_normal(corners).normalized();
}

int edge_between(const Shape& shape, int from, int to) {
  const auto found = std::ranges::find_if(shape.edges, [&](const std::array<int, 2>& edge) {
    return (edge[0] == from && edge[1] == to) || (edge[0] == to && edge[1] == from);
  });
  return found == shape.edges.end() ? -1 : static_cast<int>(found - shape.edges.begin());
}

/// The face of a convex polyhedron that is most aligned with `direction` (unit, local). If an edge or a
/// face is in front, only its faces count: the face next to a sharp edge may point elsewhere.
int facing(const Shape& shape, const Vec3d& direction) {
  double front = -std::numeric_limits<double>::infinity(), back = -front;
  for (const Vec3d& vertex : shape.vertices) {
    front = std::max(front, direction.dot(vertex));
    back = std::min(back, direction.dot(vertex));
  }
  const double flat = kFlat * (front - back);
  int best = -1;
  bool best_is_in_front = false;
  double best_alignment = -2;
  for (std::size_t i = 0; i < shape.faces.size(); ++i) {
    const std::vector<int>& face = shape.faces[i];
    const bool in_front = std::ranges::count_if(face, [&](int vertex) {
                            return front - direction.dot(at(shape.vertices, vertex)) <= flat;
                          }) >= 2;
    const double alignment = normal_of(shape, face).dot(direction);
    if (in_front < best_is_in_front ||
        (in_front == best_is_in_front && alignment <= best_alignment))
      continue;
    best = static_cast<int>(i);
    best_is_in_front = in_front;
    best_alignment = alignment;
  }
  return best;
}

/// The triangle of a mesh nearest to a point (local). Of equally near ones, such as two that share
/// an edge, the one more aligned with `direction` wins.
int nearest_triangle(const Shape& mesh, const Vec3d& point, const Vec3d& direction) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const std::vector<int>& face = mesh.faces[i];
    const Vec3d& origin = at(mesh.vertices, face[0]);
    const Vec3d normal = normal_of(mesh, face);
    // Distance from the triangle: sideways beyond its edges, or along its normal.
    double out = std::abs(normal.dot(point - origin));
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vec3d& from = at(mesh.vertices, face[k]);
      const Vec3d& to = at(mesh.vertices, face[(k + 1) % face.size()]);
      out = std::max(out, (to - from).cross(normal).normalized().dot(point - from));
    }
    out += 1e-3 * (1 - normal.dot(direction)) * (at(mesh.vertices, face[1]) - origin).norm();
    if (out >= least) continue;
    least = out;
    best = static_cast<int>(i);
  }
  return best;
}

/// True for a capsule along the normal; the end in front touches.
bool is_seen_end_on(const Outline& outline, const Shape& shape) {
  return outline.corners.size() == 2 &&
         (outline.corners[1] - outline.corners[0]).norm() < kNear * shape.radius;
}

}  // namespace

Outline outline_of(const PlacedShape& placed, const Manifold& manifold, const Vec3d& direction,
                   const ContactPlane& plane) {
  const Shape& shape = placed.shape;
  Outline outline;
  const auto add = [&](int vertex, int edge, int number) {
    outline.corners.push_back(plane.seen(placed.vertex(vertex)));
    outline.vertices.push_back(number);
    outline.edges.push_back(edge);
  };
  if (shape.half_space) return outline;
  if (shape.faces.empty()) {
    for (int i = 0; i < static_cast<int>(shape.vertices.size()); ++i) add(i, 0, i);
    if (is_seen_end_on(outline, shape)) {
      const int front = direction.dot(placed.vertex(0)) > direction.dot(placed.vertex(1)) ? 0 : 1;
      outline = {};
      add(front, 0, front);
    }
  } else {
    const Vec3d local = placed.pose.inverse_rotate(direction);
    const bool is_mesh = shape.type == "mesh";
    outline.face =
        !is_mesh ? facing(shape, local)
        : manifold.triangle
            ? *manifold.triangle
            : nearest_triangle(shape, placed.pose.inverse_transform(manifold.points[0].position),
                               local);
    if (outline.face < 0 || outline.face >= static_cast<int>(shape.faces.size())) return outline;
    const std::vector<int>& face = at(shape.faces, outline.face);
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int next = face[(i + 1) % face.size()];
      const int corner = static_cast<int>(i);
      add(face[i], is_mesh ? corner : edge_between(shape, face[i], next),
          is_mesh ? corner : face[i]);
    }
    outline.is_face = true;
    outline.alignment = normal_of(shape, face).dot(local);
    if (is_mesh) outline.face = 0;  // ids of a mesh are relative to the triangle
  }
  for (const Vec2d& corner : outline.corners)
    outline.size = std::max(outline.size, (corner - outline.corners[0]).norm());
  return outline;
}

Place place_on(const Outline& outline, const Vec2d& point, double near) {
  const std::size_t count = outline.corners.size();
  if (count == 0) return {FeatureKind::Face, 0};  // a plane
  if (count == 1) return {FeatureKind::Vertex, 0};
  Place place;
  double least = near;
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = (outline.corners[i] - point).norm();
    if (distance > least) continue;
    least = distance;
    place = {FeatureKind::Vertex, i};
  }
  if (place.kind == FeatureKind::Vertex) return place;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < (count == 2 ? 1 : count); ++i) {
    const Vec2d& from = outline.corners[i];
    const Vec2d along = outline.corners[(i + 1) % count] - from;
    const double t = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (point - from - t * along).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    place.corner = i;
  }
  if (nearest <= near || !outline.is_face) place.kind = FeatureKind::Edge;
  return place;
}

}  // namespace contactscope::trace

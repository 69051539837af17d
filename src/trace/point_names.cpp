#include "trace/point_names.h"

#include <algorithm>
#include <limits>
#include <string_view>
#include <unordered_map>

#include "core/feature_id.h"

// A clipped point is where two edges cross as seen along the normal: an edge of either shape, or two of
// the incident face, whose vertex has stayed, or two of the reference face (Catto 2007, "Feature-Based
// Contact Points"). So it does not matter which surface an engine puts its points on.
// Steps: the outline of each shape that looks at the other one; on which feature of each outline the
// point lies; the id that these two features make.
namespace contactscope::trace {
namespace {

using Vec2d = Eigen::Vector2d;

// A point is on an edge from this part of its outline's size on: engines compute in float, and many
// round positions of points, or move them by a slop.
constexpr double kNear = 2e-4;
// Triangles of a mesh that are searched one by one for the one that is met; in larger meshes that would
// take longer than to draw them.
constexpr std::size_t kMostSearched = 20000;
// A vertex stands out of the plane of a support by this part of the shape's size.
constexpr double kFlat = 1e-4;

/// What of a shape can touch, seen along the normal: a face's corners, the ends of a capsule's segment, a
/// sphere's centre, of a plane none. Edge i runs from corner i to the next.
struct Outline {
  std::vector<Vec2d> corners{};
  std::vector<int> vertices{}, edges{};  // numbers of the corners, and of the edges from them
  int face = 0;                          // its number
  double alignment = 0;                  // cosine between its normal and the other shape's way
  double size = 0;                       // metres
  bool is_face = false;
};

struct Plane2 {
  Vec3d u, v;
  explicit Plane2(const Vec3d& normal) : u(any_perpendicular(normal)), v(normal.cross(u)) {}
  Vec2d seen(const Vec3d& point) const { return {u.dot(point), v.dot(point)}; }
};

struct Placed {
  const Shape& shape;
  const Pose<double>& pose;
  Vec3d vertex(int index) const {
    return pose.transform(shape.vertices[static_cast<std::size_t>(index)]);
  }
};

/// Newell's normal of a polygon, not of unit length.
Vec3d normal_of(const Shape& shape, const std::vector<int>& face) {
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 0; i < face.size(); ++i)
    normal += shape.vertices[static_cast<std::size_t>(face[i])].cross(
        shape.vertices[static_cast<std::size_t>(face[(i + 1) % face.size()])]);
  return normal;
}

int edge_between(const Shape& shape, int from, int to) {
  const auto found = std::ranges::find_if(shape.edges, [&](const std::array<int, 2>& edge) {
    return (edge[0] == from && edge[1] == to) || (edge[0] == to && edge[1] == from);
  });
  return found == shape.edges.end() ? -1 : static_cast<int>(found - shape.edges.begin());
}

/// The face of a convex polyhedron that looks most along `way` (unit, local). Where an edge or a face is
/// in front, of those alone that have it: the face next to a sharp edge may look elsewhere.
int facing(const Shape& shape, const Vec3d& way) {
  double front = -std::numeric_limits<double>::infinity(), back = -front;
  for (const Vec3d& vertex : shape.vertices) {
    front = std::max(front, way.dot(vertex));
    back = std::min(back, way.dot(vertex));
  }
  const double flat = kFlat * (front - back);
  int best = -1;
  bool best_is_in_front = false;
  double best_alignment = -2;
  for (std::size_t i = 0; i < shape.faces.size(); ++i) {
    const std::vector<int>& face = shape.faces[i];
    const bool in_front =
        std::ranges::count_if(face, [&](int vertex) {
          return front - way.dot(shape.vertices[static_cast<std::size_t>(vertex)]) <= flat;
        }) >= 2;
    const double alignment = normal_of(shape, face).normalized().dot(way);
    if (in_front < best_is_in_front ||
        (in_front == best_is_in_front && alignment <= best_alignment))
      continue;
    best = static_cast<int>(i);
    best_is_in_front = in_front;
    best_alignment = alignment;
  }
  return best;
}

/// The triangle of a mesh nearest to a point that looks `way` (both local), by the distance from its
/// corners' box; of none that looks there the nearest.
int nearest_triangle(const Shape& mesh, const Vec3d& point, const Vec3d& way) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const std::vector<int>& face = mesh.faces[i];
    const Vec3d& origin = mesh.vertices[static_cast<std::size_t>(face[0])];
    const Vec3d normal = normal_of(mesh, face).normalized();
    // How far the point is out of the triangle, sideways beyond its edges or along its normal.
    double out = std::abs(normal.dot(point - origin));
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vec3d& from = mesh.vertices[static_cast<std::size_t>(face[k])];
      const Vec3d& to = mesh.vertices[static_cast<std::size_t>(face[(k + 1) % face.size()])];
      out = std::max(out, (to - from).cross(normal).normalized().dot(point - from));
    }
    out += 1e-3 * (1 - normal.dot(way)) *
           (mesh.vertices[static_cast<std::size_t>(face[1])] - origin).norm();
    if (out >= least) continue;
    least = out;
    best = static_cast<int>(i);
  }
  return best;
}

/// Of a capsule along the normal the end in front is met.
bool is_seen_end_on(const Outline& outline, const Shape& shape) {
  return outline.corners.size() == 2 &&
         (outline.corners[1] - outline.corners[0]).norm() < kNear * shape.radius;
}

Outline outline_of(const Placed& placed, const Manifold& manifold, const Vec3d& way,
                   const Plane2& plane) {
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
      const int front = way.dot(placed.vertex(0)) > way.dot(placed.vertex(1)) ? 0 : 1;
      outline = {};
      add(front, 0, front);
    }
  } else {
    const Vec3d local = placed.pose.inverse_rotate(way);
    const bool is_mesh = shape.type == "mesh";
    outline.face =
        !is_mesh ? facing(shape, local)
        : manifold.triangle
            ? *manifold.triangle
            : nearest_triangle(shape, placed.pose.inverse_transform(manifold.points[0].position),
                               local);
    if (outline.face < 0 || outline.face >= static_cast<int>(shape.faces.size())) return outline;
    const std::vector<int>& face = shape.faces[static_cast<std::size_t>(outline.face)];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int next = face[(i + 1) % face.size()];
      const int corner = static_cast<int>(i);
      add(face[i], is_mesh ? corner : edge_between(shape, face[i], next),
          is_mesh ? corner : face[i]);
    }
    outline.is_face = true;
    outline.alignment = normal_of(shape, face).normalized().dot(local);
    if (is_mesh) outline.face = 0;  // features of a mesh count within the triangle
  }
  for (const Vec2d& corner : outline.corners)
    outline.size = std::max(outline.size, (corner - outline.corners[0]).norm());
  return outline;
}

/// Where on an outline a point lies: a corner, the edge from it, or neither.
struct Place {
  FeatureKind kind = FeatureKind::Face;
  std::size_t corner = 0;
};

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
  // A point beyond all edges by more than `near` is still one of the nearest edge.
  double nearest = std::numeric_limits<double>::infinity(), farthest_out = -nearest;
  for (std::size_t i = 0; i < (count == 2 ? 1 : count); ++i) {
    const Vec2d& from = outline.corners[i];
    const Vec2d along = outline.corners[(i + 1) % count] - from;
    const double t = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (point - from - t * along).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    place.corner = i;
    farthest_out = distance;
  }
  if (farthest_out <= near || !outline.is_face) place.kind = FeatureKind::Edge;
  return place;
}

FeatureRef feature(const Outline& outline, const Place& place, Owner owner) {
  const auto number = [&] {
    switch (place.kind) {
      case FeatureKind::Vertex:
        return outline.vertices[place.corner];
      case FeatureKind::Edge:
        return outline.edges[place.corner];
      case FeatureKind::Face:
        break;
    }
    return outline.face;
  };
  return {owner, place.kind, static_cast<std::uint32_t>(std::max(0, number()))};
}

/// The two edges of an outline that meet in its corner.
FeatureId corner_id(const Outline& outline, const Place& place, Owner owner) {
  const std::size_t count = outline.corners.size();
  const auto edge = [&](std::size_t i) {
    return edge_ref(owner, std::max(0, outline.edges[i % count]));
  };
  return FeatureId::of(edge(place.corner), edge(place.corner + count - 1));
}

/// Unit, along the edge from the corner of a place.
Vec2d edge_way(const Outline& outline, const Place& place) {
  const std::size_t next = (place.corner + 1) % outline.corners.size();
  return (outline.corners[next] - outline.corners[place.corner]).normalized();
}

/// Of the two edges that meet in a corner the one more across `way`.
std::uint32_t steeper_edge(const Outline& outline, const Place& corner, const Vec2d& way) {
  const std::size_t count = outline.corners.size();
  const Place before{FeatureKind::Edge, (corner.corner + count - 1) % count};
  const Place& steeper =
      std::abs(edge_way(outline, before).dot(way)) < std::abs(edge_way(outline, corner).dot(way))
          ? before
          : corner;
  return static_cast<std::uint32_t>(std::max(0, outline.edges[steeper.corner]));
}

FeatureId id_of(const Outline& a, const Outline& b, const Place& on_a, const Place& on_b,
                bool is_clipped) {
  const FeatureId direct = FeatureId::of(feature(a, on_a, Owner::A), feature(b, on_b, Owner::B));
  if (!is_clipped) return direct;
  // The face that looks more along the normal is the reference; a vertex of the other one has stayed
  // where it is, also where it lies on a side plane.
  const bool a_is_reference = a.alignment >= b.alignment - 1e-6;
  const bool corner_of_a = on_a.kind == FeatureKind::Vertex;
  const bool corner_of_b = on_b.kind == FeatureKind::Vertex;
  if (!corner_of_a && !corner_of_b) return direct;
  const bool of_a = corner_of_a && (!corner_of_b || !a_is_reference);
  const Outline& outline = of_a ? a : b;
  const Outline& other_outline = of_a ? b : a;
  const Place& corner = of_a ? on_a : on_b;
  const Place& other_place = of_a ? on_b : on_a;
  const Owner owner = of_a ? Owner::A : Owner::B;
  if (of_a != a_is_reference || other_place.kind != FeatureKind::Edge)
    return corner_id(outline, corner, owner);
  // A corner of the reference face on an edge of the incident one: that edge was cut there, by the
  // side plane that it crosses more steeply.
  return FeatureId::of(
      edge_ref(owner, steeper_edge(outline, corner, edge_way(other_outline, other_place))),
      feature(other_outline, other_place, other(owner)));
}

void name_manifold(const Placed& a, const Placed& b, Manifold& manifold) {
  if (manifold.points.empty() || manifold.normal.squaredNorm() < 0.5) return;
  const Vec3d normal = manifold.normal.normalized();
  const Plane2 plane(normal);
  const Outline on_a = outline_of(a, manifold, normal, plane);
  const Outline on_b = outline_of(b, manifold, -normal, plane);
  const double size = on_a.size > 0 && on_b.size > 0 ? std::min(on_a.size, on_b.size)
                                                     : std::max(on_a.size, on_b.size);
  const bool is_clipped =
      on_a.is_face && on_b.is_face && (manifold.axis.empty() || manifold.axis.starts_with("face"));
  for (Point& point : manifold.points) {
    const Vec2d seen = plane.seen(point.position);
    Place at_a = place_on(on_a, seen, kNear * size), at_b = place_on(on_b, seen, kNear * size);
    if (manifold.axis == "edge_edge") at_a.kind = at_b.kind = FeatureKind::Edge;
    point.id = to_string(id_of(on_a, on_b, at_a, at_b, is_clipped));
  }
}

bool knows_triangle(const Shape& shape, const Manifold& manifold) {
  return shape.type != "mesh" || manifold.triangle || shape.faces.size() <= kMostSearched;
}

/// Also of a pair without points.
bool has_ids(const Pair& pair) {
  return pair.manifolds.empty() ||
         std::ranges::any_of(pair.manifolds, [](const Manifold& manifold) {
           return std::ranges::any_of(manifold.points,
                                      [](const Point& point) { return !point.id.empty(); });
         });
}

}  // namespace

void name_points(const std::vector<Shape>& shapes, Frame& frame) {
  if (std::ranges::all_of(frame.pairs, has_ids)) return;
  std::unordered_map<std::string_view, const Shape*> shape_of;
  for (const Shape& shape : shapes) shape_of.emplace(shape.name, &shape);
  std::unordered_map<std::string_view, const Pose<double>*> pose_of;
  for (const Placement& placement : frame.poses)
    pose_of.emplace(placement.first, &placement.second);
  const auto placed = [&](const std::string& name) -> std::optional<Placed> {
    const auto shape = shape_of.find(name);
    const auto pose = pose_of.find(name);
    if (shape == shape_of.end() || pose == pose_of.end() || shape->second->type == "sdf")
      return std::nullopt;
    return Placed{*shape->second, *pose->second};
  };
  for (Pair& pair : frame.pairs) {
    if (has_ids(pair)) continue;
    const auto a = placed(pair.a), b = placed(pair.b);
    if (!a || !b) continue;
    for (Manifold& manifold : pair.manifolds)
      if (knows_triangle(a->shape, manifold) && knows_triangle(b->shape, manifold))
        name_manifold(*a, *b, manifold);
  }
}

}  // namespace contactscope::trace

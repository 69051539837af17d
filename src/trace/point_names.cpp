#include "trace/find.h"

#include "core/feature_id.h"

// Seen along the normal, a clipped point is where two edges cross: one edge of each shape, two
// edges of the incident face at a vertex inside, or two of the reference face (Catto 2007,
// "Feature-Based Contact Points"). So the surface on which an engine puts its points does not
// matter. Steps: the outline of each shape's side that faces the other; the feature of each outline
// that the point is on; the id made of these two features.
namespace contactscope::trace {
namespace {

using Vec2d = Eigen::Vector2d;

// Largest distance of a point on an edge, relative to the outline's size: engines compute in float,
// and many round positions or move them by a slop.
constexpr double kNear = 2e-4;

/// The feature of a shape that can touch, seen along the normal: a face's corners, a capsule's
/// segment, a sphere's centre, nothing for a plane. Edge i runs from corner i to the next.
struct Outline {
  std::vector<Vec2d> corners{};
  std::vector<int> vertices{}, edges{};  // numbers of the corners, and of edges that start there
  int face = 0;
  double alignment = 0;  // cosine between its normal and `direction` of outline_of()
  double size = 0;       // metres
  bool is_face = false;
};

/// The plane perpendicular to a normal (unit), onto which contacts are projected.
struct ContactPlane {
  Vec3d u, v;
  explicit ContactPlane(const Vec3d& normal) : u(any_perpendicular(normal)), v(normal.cross(u)) {}
  Vec2d seen(const Vec3d& point) const { return {u.dot(point), v.dot(point)}; }
};

struct PlacedShape {
  const Shape& shape;
  const Pose<double>& pose;
  Vec3d vertex(int index) const { return pose.transform(at(shape.vertices, index)); }
};

/// The feature of an outline that a point is on: a corner, the edge that starts there, or neither.
struct Place {
  FeatureKind kind = FeatureKind::Face;
  std::size_t corner = 0;
};

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
    if (in_front < best_is_in_front) continue;
    const double alignment = normal_of(shape, face).dot(direction);
    if (in_front == best_is_in_front && alignment <= best_alignment) continue;
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

/// Outline of the side of a shape that faces `direction` (unit, world). For a mesh it is the manifold's
/// triangle, or the nearest one. Empty if no side faces `direction`.
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

/// `near`: largest distance, in metres, of a point on a corner or an edge.
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

// Largest mesh that is searched triangle by triangle; in larger ones the search would take longer
// than drawing them.
constexpr std::size_t kMaxSearched = 20000;

FeatureRef feature(const Outline& outline, const Place& place, Owner owner) {
  const int number = place.kind == FeatureKind::Vertex ? outline.vertices[place.corner]
                     : place.kind == FeatureKind::Edge ? outline.edges[place.corner]
                                                       : outline.face;
  return {owner, place.kind, static_cast<std::uint32_t>(std::max(0, number))};
}

/// The two edges of an outline that share a corner.
FeatureId corner_id(const Outline& outline, const Place& place, Owner owner) {
  const std::size_t count = outline.corners.size();
  const auto edge = [&](std::size_t i) {
    return edge_ref(owner, std::max(0, outline.edges[i % count]));
  };
  return FeatureId::of(edge(place.corner), edge(place.corner + count - 1));
}

/// Unit, along the edge that starts at the corner of a place.
Vec2d edge_direction(const Outline& outline, const Place& place) {
  const std::size_t next = (place.corner + 1) % outline.corners.size();
  return (outline.corners[next] - outline.corners[place.corner]).normalized();
}

/// The edge at a corner that is more perpendicular to `direction`.
std::uint32_t steeper_edge(const Outline& outline, const Place& corner, const Vec2d& direction) {
  const std::size_t count = outline.corners.size();
  const Place before{FeatureKind::Edge, (corner.corner + count - 1) % count};
  const Place& steeper = std::abs(edge_direction(outline, before).dot(direction)) <
                                 std::abs(edge_direction(outline, corner).dot(direction))
                             ? before
                             : corner;
  return static_cast<std::uint32_t>(std::max(0, outline.edges[steeper.corner]));
}

FeatureId id_of(const Outline& a, const Outline& b, const Place& on_a, const Place& on_b,
                bool is_clipped) {
  const FeatureId direct = FeatureId::of(feature(a, on_a, Owner::A), feature(b, on_b, Owner::B));
  if (!is_clipped) return direct;
  // The face more aligned with the normal is the reference. A vertex of the other face is not cut,
  // even if it lies on a side plane.
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
  // A corner of the reference face on an edge of the incident one: the side plane that this edge
  // crosses more steeply cut it there.
  return FeatureId::of(
      edge_ref(owner, steeper_edge(outline, corner, edge_direction(other_outline, other_place))),
      feature(other_outline, other_place, other(owner)));
}

/// The end of a segment that is nearest to a point.
Place nearest_end(const Outline& segment, const Vec2d& point) {
  const double first = (segment.corners.front() - point).norm();
  const bool is_first = first <= (segment.corners.back() - point).norm();
  return {FeatureKind::Vertex, is_first ? 0U : segment.corners.size() - 1};
}

void name_manifold(const PlacedShape& a, const PlacedShape& b, Manifold& manifold) {
  if (manifold.points.empty() || manifold.normal.squaredNorm() < 0.5) return;
  const Vec3d normal = manifold.normal.normalized();
  const ContactPlane plane(normal);
  const Outline on_a = outline_of(a, manifold, normal, plane);
  const Outline on_b = outline_of(b, manifold, -normal, plane);
  const double size = on_a.size > 0 && on_b.size > 0 ? std::min(on_a.size, on_b.size)
                                                     : std::max(on_a.size, on_b.size);
  const bool is_clipped =
      on_a.is_face && on_b.is_face && (manifold.axis.empty() || manifold.axis.starts_with("face"));
  // Parallel capsules touch in two points; each is named by the ends next to it, whichever cuts.
  const bool has_ends = a.shape.type == "capsule" && b.shape.type == "capsule" &&
                        manifold.points.size() == 2 && !on_a.corners.empty() &&
                        !on_b.corners.empty();
  for (Point& point : manifold.points) {
    const Vec2d seen = plane.seen(point.position);
    Place at_a = has_ends ? nearest_end(on_a, seen) : place_on(on_a, seen, kNear * size);
    Place at_b = has_ends ? nearest_end(on_b, seen) : place_on(on_b, seen, kNear * size);
    if (manifold.axis == "edge_edge") at_a.kind = at_b.kind = FeatureKind::Edge;
    point.id = to_string(id_of(on_a, on_b, at_a, at_b, is_clipped));
  }
}

bool knows_triangle(const Shape& shape, const Manifold& manifold) {
  return shape.type != "mesh" || manifold.triangle || shape.faces.size() <= kMaxSearched;
}

/// True for pairs without points.
bool has_ids(const Pair& pair) {
  return pair.manifolds.empty() ||
         std::ranges::any_of(pair.manifolds, [](const Manifold& manifold) {
           return std::ranges::any_of(manifold.points,
                                      [](const Point& point) { return !point.id.empty(); });
         });
}

}  // namespace

bool name_points(const std::vector<Shape>& shapes, Frame& frame) {
  if (std::ranges::all_of(frame.pairs, has_ids)) return false;
  std::unordered_map<std::string_view, const Shape*> shape_of;
  for (const Shape& shape : shapes) shape_of.emplace(shape.name, &shape);
  std::unordered_map<std::string_view, const Pose<double>*> pose_of;
  for (const Placement& placement : frame.poses)
    pose_of.emplace(placement.first, &placement.second);
  const auto placed = [&](const std::string& name) -> std::optional<PlacedShape> {
    const auto shape = shape_of.find(name);
    const auto pose = pose_of.find(name);
    if (shape == shape_of.end() || pose == pose_of.end() || shape->second->type == "sdf")
      return std::nullopt;
    return PlacedShape{*shape->second, *pose->second};
  };
  for (Pair& pair : frame.pairs) {
    if (has_ids(pair)) continue;
    const auto a = placed(pair.a), b = placed(pair.b);
    if (!a || !b) continue;
    for (Manifold& manifold : pair.manifolds)
      if (knows_triangle(a->shape, manifold) && knows_triangle(b->shape, manifold))
        name_manifold(*a, *b, manifold);
  }
  return true;
}

}  // namespace contactscope::trace

#include "trace/point_names.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "trace/outline.h"

// Seen along the normal, a clipped point is where two edges cross: one edge of each shape, two
// edges of the incident face at a vertex inside, or two of the reference face (Catto 2007,
// "Feature-Based Contact Points"). So the surface on which an engine puts its points does not
// matter. Steps: the outline of each shape's side that faces the other; the feature of each outline
// that the point is on; the id made of these two features.
namespace contactscope::trace {
namespace {

// Largest mesh that is searched triangle by triangle; in larger ones the search would take longer
// than drawing them.
constexpr std::size_t kMaxSearched = 20000;

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

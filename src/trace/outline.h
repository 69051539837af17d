#pragma once

#include <vector>

#include "core/at.h"
#include "core/feature_id.h"
#include "trace/trace.h"

namespace contactscope::trace {

using Vec2d = Eigen::Vector2d;

// Largest distance of a point on an edge, relative to the outline's size: engines compute in float,
// and many round positions or move them by a slop.
inline constexpr double kNear = 2e-4;

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

/// Outline of the side of a shape that faces `direction` (unit, world). For a mesh it is the manifold's
/// triangle, or the nearest one. Empty if no side faces `direction`.
Outline outline_of(const PlacedShape& placed, const Manifold& manifold, const Vec3d& direction,
                   const ContactPlane& plane);

/// The feature of an outline that a point is on: a corner, the edge that starts there, or neither.
struct Place {
  FeatureKind kind = FeatureKind::Face;
  std::size_t corner = 0;
};

/// `near`: largest distance, in metres, of a point on a corner or an edge.
Place place_on(const Outline& outline, const Vec2d& point, double near);

}  // namespace contactscope::trace

#pragma once

#include <vector>

#include "core/at.h"
#include "core/feature_id.h"
#include "trace/trace.h"

namespace contactscope::trace {

using Vec2d = Eigen::Vector2d;

// A point is on an edge from this part of its outline's size on: engines compute in float, and many
// round positions of points, or move them by a slop.
inline constexpr double kNear = 2e-4;

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

/// The plane across a normal (unit), in which contacts are seen.
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

/// Of the shape's side that looks `way` (unit, world), at the place of a manifold of it: of a mesh that of the triangle
/// that the manifold names, or of the nearest one. Empty where there is no such side.
Outline outline_of(const PlacedShape& placed, const Manifold& manifold, const Vec3d& offset,
                   const ContactPlane& plane);

/// Where on an outline a point lies: a corner, the edge from it, or neither.
struct Place {
  FeatureKind kind = FeatureKind::Face;
  std::size_t corner = 0;
};

/// `near`: metres up to which a point is on a corner or an edge.
Place place_on(const Outline& outline, const Vec2d& point, double near);

}  // namespace contactscope::trace

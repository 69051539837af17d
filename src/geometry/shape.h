#pragma once

#include <array>
#include <memory>
#include <variant>

#include "core/plane.h"
#include "geometry/hull.h"
#include "geometry/mesh.h"

namespace contactscope {

/// Ball about the origin of its own frame.
template <class S>
struct Sphere {
  S radius = 0;  // metres, > 0
};

/// All points within `radius` of a segment. The segment may have length zero: then it is a ball.
template <class S>
struct Capsule {
  std::array<Vec3<S>, 2> points;  // ends of the segment, own frame, metres
  S radius = 0;                   // metres, > 0
};

/// Everything below a plane: the points x with normal . x <= offset, own frame. Scenarios call it
/// "plane", as engines do.
template <class S>
struct HalfSpace {
  Plane<S> plane;
};

class DistanceField;  // src/field
template <class S>
struct FieldSource;

/// A solid by the distances to its surface: a lattice of them, see field/distance_field.h, and the shape
/// that it was made of, in one frame. Scenarios call it "sdf". Bounds, mass and pictures are those of
/// the shape that it was made of.
template <class S>
struct Field {
  std::shared_ptr<const DistanceField> values;   // unit: a cell
  Vec3d origin = Vec3d::Zero();                  // of the lattice, own frame, metres
  double cell = 1;                               // metres
  std::shared_ptr<const FieldSource<S>> source;  // never null
};

/// Anything that can collide, in its own frame. The order is that of the collision table, which has
/// an upper half only: a pair is worked on with the earlier type first.
template <class S>
using Shape = std::variant<Sphere<S>, Capsule<S>, Hull<S>, HalfSpace<S>, Mesh<S>, Field<S>>;

/// What a field was made of: a sphere, a capsule, a hull or a mesh.
template <class S>
struct FieldSource {
  Shape<S> shape;
};

/// What a field was made of; any other shape is itself.
template <class S>
const Shape<S>& made_of(const Shape<S>& shape) {
  const auto* field = std::get_if<Field<S>>(&shape);
  return field == nullptr ? shape : field->source->shape;
}

/// Position of a type in `Shape`.
enum class ShapeKind { Sphere, Capsule, Hull, Plane, Mesh, Field };
inline constexpr int kShapeKinds = 6;

template <class S>
ShapeKind kind_of(const Shape<S>& shape) {
  return static_cast<ShapeKind>(shape.index());
}

/// Spheres, capsules and hulls: what has a support function.
constexpr bool is_convex(ShapeKind kind) {
  return kind <= ShapeKind::Hull;
}

/// "sphere", "capsule", "hull", "plane", "mesh", "sdf"; a pair is called "sphere-hull".
constexpr const char* to_string(ShapeKind kind) {
  constexpr const char* kNames[] = {"sphere", "capsule", "hull", "plane", "mesh", "sdf"};
  return kNames[static_cast<int>(kind)];
}

/// The same shape in another scalar, every coordinate rounded once.
template <class T>
Shape<T> shape_cast(const Shape<double>& shape);

/// Where in its own frame the origin of a shape is moved to, because its vertices are far from it, as
/// those of level geometry are: in single precision the distance eats the digits that the form needs,
/// and tolerances grow with it. Engines move such a shape to its middle in double before it is
/// rounded; its pose makes up for it. The middle of its box, each coordinate a float, so that a pose
/// that stands still at the world's origin stays exact; zero where the shape is left as it is.
Vec3d moved_origin(const Shape<double>& shape);
/// Likewise of a shape that reaches `margin` metres beyond this box.
Vec3d middle_where_far(const Aabb<double>& box, double margin);

/// The same shape in a frame with the same axes whose origin is at `origin` of the shape's own
/// frame, metres.
Shape<double> seen_from(const Shape<double>& shape, const Vec3d& origin);

/// The same shape, `factor` > 0 times as large, about its own origin.
Shape<double> scaled(const Shape<double>& shape, double factor);

}  // namespace contactscope

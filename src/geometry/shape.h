#pragma once

#include "geometry/mesh.h"

namespace contactscope {

/// A ball centred on the origin of its own frame.
template <class S> struct Sphere {
  S radius = 0;  // metres, > 0
};

/// All points within `radius` of a segment. A segment of length zero makes a ball.
template <class S> struct Capsule {
  std::array<Vec3<S>, 2> points;  // ends of the segment, own frame, metres
  S radius = 0;                   // metres, > 0
};

/// Everything below a plane: normal . x <= offset, own frame. Scenarios call it "plane".
template <class S> struct HalfSpace { Plane<S> plane; };

class DistanceField;  // src/field
template <class S> struct FieldSource;

/// A solid given by a lattice of signed distances (field/distance_field.h), "sdf" in scenarios.
/// Bounds, mass and pictures use the shape it was built from, in the same frame.
template <class S> struct Field {
  std::shared_ptr<const DistanceField> values;   // unit: a cell
  Vec3d origin = Vec3d::Zero();                  // origin of the lattice, own frame, metres
  double cell = 1;                               // edge length, metres
  std::shared_ptr<const FieldSource<S>> source;  // never null
};

/// Any shape that can collide, in its own frame. The collision table has only an upper half, in
/// this order: each pair is handled with the earlier type first.
template <class S>
using Shape = std::variant<Sphere<S>, Capsule<S>, Hull<S>, HalfSpace<S>, Mesh<S>, Field<S>>;

/// The shape that a field was built from: a sphere, a capsule, a hull or a mesh.
template <class S> struct FieldSource { Shape<S> shape; };

/// The source shape of a field; any other shape is returned unchanged.
template <class S> const Shape<S>& made_of(const Shape<S>& shape) {
  const auto* field = std::get_if<Field<S>>(&shape);
  return field == nullptr ? shape : field->source->shape;
}

/// Index of a type in `Shape`.
enum class ShapeKind { Sphere, Capsule, Hull, Plane, Mesh, Field };
inline constexpr int kShapeKinds = 6;

template <class S> ShapeKind kind_of(const Shape<S>& shape) {
  return static_cast<ShapeKind>(shape.index());
}

/// True for shapes with a support function: spheres, capsules and hulls.
constexpr bool is_convex(ShapeKind kind) { return kind <= ShapeKind::Hull; }

/// Names of single shapes; a pair is called "sphere-hull".
constexpr const char* to_string(ShapeKind kind) {
  constexpr const char* kNames[] = {"sphere", "capsule", "hull", "plane", "mesh", "sdf"};
  return kNames[static_cast<int>(kind)];
}

/// The same shape in another scalar type. Every coordinate is rounded once.
template <class T> Shape<T> shape_cast(const Shape<double>& shape);

/// New origin for a shape whose vertices are far from its own origin, as in level geometry; zero if
/// the shape can stay as it is. Far from the origin, single precision loses the digits of the shape
/// and tolerances grow. Engines therefore move the shape to its centre in double before rounding
/// it, and adjust its pose. The result is the centre of the shape's box, own frame, metres. Each
/// coordinate is a float, so that a pose at rest at the world's origin stays exact.
Vec3d moved_origin(const Shape<double>& shape);
/// The same for a shape that extends `margin` metres beyond this box.
Vec3d middle_where_far(const Aabb<double>& box, double margin);

/// The same shape in a frame with the same axes and its origin at `origin` (old frame, metres).
Shape<double> seen_from(const Shape<double>& shape, const Vec3d& origin);

/// The shape scaled about its own origin by `factor` > 0.
Shape<double> scaled(const Shape<double>& shape, double factor);

}  // namespace contactscope

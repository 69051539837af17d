#pragma once

#include <variant>

#include "geometry/capsule.h"
#include "geometry/half_space.h"
#include "geometry/hull.h"
#include "geometry/mesh.h"
#include "geometry/sphere.h"

namespace contactscope {

/// Anything that can collide, in its own frame. The order is that of the collision table, which has
/// an upper half only: a pair is worked on with the earlier type first.
template <class S>
using Shape = std::variant<Sphere<S>, Capsule<S>, Hull<S>, HalfSpace<S>, Mesh<S>>;

/// Position of a type in `Shape`.
enum class ShapeKind { Sphere, Capsule, Hull, Plane, Mesh };
inline constexpr int kShapeKinds = 5;

template <class S>
ShapeKind kind_of(const Shape<S>& shape) {
  return static_cast<ShapeKind>(shape.index());
}

/// "sphere", "capsule", "hull", "plane", "mesh"; a pair is called "sphere-hull".
constexpr const char* to_string(ShapeKind kind) {
  constexpr const char* kNames[] = {"sphere", "capsule", "hull", "plane", "mesh"};
  return kNames[static_cast<int>(kind)];
}

/// The same shape in another scalar, every coordinate rounded once.
template <class T>
Shape<T> shape_cast(const Shape<double>& shape);

}  // namespace contactscope

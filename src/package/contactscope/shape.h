#pragma once

#include <array>
#include <concepts>
#include <memory>
#include <stdexcept>
#include <variant>
#include <vector>

#include "manifold.h"

/// Shapes as plain data, each in its own frame, metres.
namespace contactscope::package {

/// Ball about the origin.
struct Sphere {
  double radius = 0;  // > 0
};

/// All points within `radius` of a segment, whose ends may be one place.
struct Capsule {
  Vec3 from{}, to{};
  double radius = 0;  // > 0
};

/// About the origin, along the axes.
struct Box {
  Vec3 half_extents{};  // each > 0
};

/// The convex hull of its vertices. With `faces`, vertex indices counter-clockwise as seen from outside,
/// vertices and faces keep their numbers, and that they are convex is the caller's promise; without
/// them the hull is built, and leaves out what lies inside.
struct Hull {
  std::vector<Vec3> vertices{};
  std::vector<std::vector<int>> faces{};
};

/// Everything below: the points x with normal . x <= offset.
struct Plane {
  Vec3 normal{0, 1, 0};  // outward; made unit, with the offset
  double offset = 0;     // metres, along it
};

/// Triangles with their front to the side from which the vertices run counter-clockwise.
struct Mesh {
  std::vector<Vec3> vertices{};
  std::vector<std::array<int, 3>> triangles{};
};

using Shape = std::variant<Sphere, Capsule, Box, Hull, Plane, Mesh>;

/// A shape cannot be made of what was given: what() says why, and what would be right.
class ShapeError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A shape made ready to collide: hulls and trees of boxes are built once, here. Copies share them;
/// several threads may use one.
class Collider {
 public:
  /// Throws ShapeError: a length that is not positive and finite, a coordinate that is not finite,
  /// vertices that bound nothing, an index of no vertex, triangles none of which has an area.
  template <class Kind>
  requires std::constructible_from<Shape, const Kind&> Collider(const Kind& shape)
      : Collider(Shape(shape), 0) {}  // so that collide() takes shapes too

  struct Built;
  const Built& built() const { return *built_; }

 private:
  Collider(const Shape& shape, int);

  std::shared_ptr<const Built> built_;
};

}  // namespace contactscope::package

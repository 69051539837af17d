#pragma once

#include <array>
#include <concepts>
#include <memory>
#include <stdexcept>
#include <variant>
#include <vector>

#include "manifold.h"

/// Shapes as plain data, each in its local frame, metres.
namespace contactscope::package {

/// Centred on the origin.
struct Sphere {
  double radius = 0;  // > 0
};

/// All points within `radius` of a segment. The segment may have length zero.
struct Capsule {
  Vec3 from{}, to{};
  double radius = 0;  // > 0
};

/// Centred on the origin, axis-aligned.
struct Box {
  Vec3 half_extents{};  // each > 0
};

/// Convex hull of vertices. `faces` are vertex indices, counter-clockwise seen from outside. With
/// them, indices are kept and the caller guarantees convexity; without them the hull is built, and
/// interior vertices are dropped.
struct Hull {
  std::vector<Vec3> vertices{};
  std::vector<std::vector<int>> faces{};
};

/// Half-space of the points x with normal . x <= offset.
struct Plane {
  Vec3 normal{0, 1, 0};  // outward; normalized together with the offset
  double offset = 0;     // metres along the normal
};

/// A triangle's front is the side from which its vertices run counter-clockwise.
struct Mesh {
  std::vector<Vec3> vertices{};
  std::vector<std::array<int, 3>> triangles{};
};

using Shape = std::variant<Sphere, Capsule, Box, Hull, Plane, Mesh>;

/// Invalid shape data: what() gives the reason and the remedy.
class ShapeError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// A shape prepared for collision: its hull and bounding tree. Copies and threads may share them.
class Collider {
 public:
  /// Throws ShapeError: a length that is not positive, a number that is not finite, vertices
  /// without volume, an invalid index, or only triangles without area.
  template <class Kind>
  requires std::constructible_from<Shape, const Kind&> Collider(const Kind& shape)
      : Collider(Shape(shape), 0) {}  // implicit, so that collide() also takes shapes

  struct Built;
  const Built& built() const { return *built_; }

 private:
  Collider(const Shape& shape, int);

  std::shared_ptr<const Built> built_;
};

}  // namespace contactscope::package

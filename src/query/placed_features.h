#pragma once

#include "core/at.h"
#include "core/plane.h"
#include "geometry/hull.h"
#include "geometry/lanes.h"

namespace contactscope {

/// A hull placed in the frame in which a pair is worked on, whose features are placed one at a time
/// as they are asked for: for contacts that look at two faces of a hull and no others. Has what
/// PlacedHull has for single features, and gives the same numbers, bit for bit.
///
/// `kMoved` is false for the hull whose own frame is the common one.
template <class S, bool kMoved>
struct PlacedFeatures {
  using Scalar = S;

  /// All outlive this. `to_frame` and `move` place the hull's own frame in the common one; not read
  /// unless the hull is moved.
  PlacedFeatures(const Hull<S>& placed, const Mat3<S>& to_frame, const Vec3<S>& move)
      : hull(placed), rotation(to_frame), position(move) {}

  const HalfEdge& half_edge(int index) const { return at(hull.half_edges, index); }
  Vec3<S> vertex(int index) const {
    const Vec3<S>& local = at(hull.vertices, index);
    if constexpr (kMoved) return rotated(local) + position;
    return local;
  }
  Vec3<S> normal(int face) const {
    const Vec3<S>& local = at(hull.planes, face).normal;
    // PlacedHull moves normals by zero.
    if constexpr (kMoved) return rotated(local) + Vec3<S>(Vec3<S>::Zero());
    return local;
  }
  Plane<S> plane(int face) const {
    const Plane<S>& local = at(hull.planes, face);
    if constexpr (kMoved) {
      const Vec3<S> n = normal(face);
      return {n, local.offset + dot(n.x(), n.y(), n.z(), position.x(), position.y(), position.z())};
    }
    return local;
  }
  Vec3<S> origin(int half_edge_index) const { return vertex(half_edge(half_edge_index).origin); }
  /// Unit vector along a half-edge, as PlacedHull's.
  Vec3<S> direction(int half_edge_index) const {
    const Vec3<S> local = hull.target(half_edge_index) - hull.origin(half_edge_index);
    if constexpr (kMoved) {
      const Vec3<S> along = rotation * local;
      return along / along.norm();
    }
    return local / local.norm();
  }

  const Hull<S>& hull;
  const Mat3<S>& rotation;
  const Vec3<S>& position;

 private:
  Vec3<S> rotated(const Vec3<S>& v) const {
    const Mat3<S>& r = rotation;
    return {dot(r(0, 0), r(0, 1), r(0, 2), v.x(), v.y(), v.z()),
            dot(r(1, 0), r(1, 1), r(1, 2), v.x(), v.y(), v.z()),
            dot(r(2, 0), r(2, 1), r(2, 2), v.x(), v.y(), v.z())};
  }
};

}  // namespace contactscope

#pragma once

#include "core/static_vector.h"
#include "geometry/hull.h"
#include "geometry/lanes.h"

namespace contactscope {

/// A hull in the common frame of a pair, laid out for the loops of the queries. Refers to `hull`,
/// also for lanes of a hull in its own frame. On the stack up to 64 vertices and 128 faces.
template <class S> struct PlacedHull {
  using Scalar = S;

  /// `to_frame` and `position` transform from the hull's own frame to the common frame.
  PlacedHull(const Hull<S>& placed, const Mat3<S>& to_frame, const Vec3<S>& position);
  /// For the hull whose own frame is the common frame.
  explicit PlacedHull(const Hull<S>& placed);
  Vec3<S> vertex(int index) const { return vertices[index]; }
  Vec3<S> normal(int face) const { return normals[face]; }
  Plane<S> plane(int face) const { return {normals[face], offsets[face]}; }
  const HalfEdge& half_edge(int index) const { return at(hull.half_edges, index); }
  Vec3<S> origin(int half_edge_index) const { return vertices[half_edge(half_edge_index).origin]; }
  /// Unit vector along a half-edge, from its origin to its target. Computed in the hull's own
  /// frame, where vertices are exact even for a small hull far from the common origin.
  Vec3<S> direction(int half_edge_index) const {
    const Vec3<S> local = hull.target(half_edge_index) - hull.origin(half_edge_index);
    const Vec3<S> along = rotation * local;
    return along / along.norm();
  }

  const Hull<S>& hull;
  Mat3<S> rotation;  // from the hull's own frame to the common frame
  VectorLanes<S> vertices;
  VectorLanes<S> normals;  // of the faces, outward, unit
  const S* offsets;        // of the face planes; padding planes are behind every point

 private:
  Scratch<S, 3 * 64 + 4 * 128> placed_;  // storage of the lanes, unless they are the hull's own
};

/// A hull in the common frame of a pair that transforms features on demand: for contacts of two
/// faces. Same interface for single features as PlacedHull, with bitwise equal results.
///
/// `kMoved` is false for the hull whose own frame is the common frame.
template <class S, bool kMoved> struct PlacedFeatures {
  using Scalar = S;

  /// Keeps references to all arguments. `to_frame` and `move` transform from the hull's own frame
  /// to the common frame; ignored unless `kMoved`.
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
    // PlacedHull also adds a zero vector to normals.
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
  /// Unit vector along a half-edge, the same as PlacedHull::direction.
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

/// Two hulls in A's frame. Computing there, near the origin, costs a pair far from the world's
/// origin no more precision than its poses have lost already.
template <class S> struct HullPair {
  HullPair(const Hull<S>& hull_a, const Hull<S>& hull_b, const Pose<S>& b_in_a);

  PlacedHull<S> a;
  PlacedHull<S> b;
  /// Metres: upper bound of all coordinates and their intermediate values.
  S scale;
  /// Metres: the smaller of the two radii.
  S min_radius;
};

}  // namespace contactscope

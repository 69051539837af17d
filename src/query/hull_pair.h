#pragma once

#include "core/at.h"
#include "core/plane.h"
#include "core/pose.h"
#include "core/scratch.h"
#include "geometry/hull.h"
#include "geometry/lanes.h"

namespace contactscope {

/// A hull placed in the frame in which a pair is worked on, laid out for the loops of the queries.
/// Topology stays in `hull`, which must outlive this; so do the lanes of a hull that is in its own
/// frame. No heap up to 64 vertices and 128 faces.
template <class S>
struct PlacedHull {
  using Scalar = S;

  /// `to_frame` and `position` place the hull's own frame in the common one.
  PlacedHull(const Hull<S>& placed, const Mat3<S>& to_frame, const Vec3<S>& position);
  /// The hull whose own frame is the common one.
  explicit PlacedHull(const Hull<S>& placed);

  Vec3<S> vertex(int index) const { return vertices[index]; }
  Vec3<S> normal(int face) const { return normals[face]; }
  Plane<S> plane(int face) const { return {normals[face], offsets[face]}; }
  const HalfEdge& half_edge(int index) const { return at(hull.half_edges, index); }
  Vec3<S> origin(int half_edge_index) const { return vertices[half_edge(half_edge_index).origin]; }
  /// Unit vector along a half-edge, from its origin to its target. Taken from the hull's own frame:
  /// there the vertices are as exact as they were given, also those of a small hull far out.
  Vec3<S> direction(int half_edge_index) const {
    const Vec3<S> local = hull.target(half_edge_index) - hull.origin(half_edge_index);
    const Vec3<S> along = rotation * local;
    return along / along.norm();
  }

  const Hull<S>& hull;
  Mat3<S> rotation;  // from the hull's own frame
  VectorLanes<S> vertices;
  VectorLanes<S> normals;  // of the faces, outward, unit
  const S* offsets;        // of the face planes; padding lies behind every point

 private:
  Scratch<S, 3 * 64 + 4 * 128> placed_;  // what the lanes above stand in, unless in the hull
};

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

/// Two hulls in A's frame. Working there, near the origin, costs a pair far from the world's origin
/// no more than its poses have lost already.
template <class S>
struct HullPair {
  HullPair(const Hull<S>& hull_a, const Hull<S>& hull_b, const Pose<S>& b_in_a);

  PlacedHull<S> a;
  PlacedHull<S> b;
  /// Metres: no coordinate, nor any intermediate value of one, is larger than this.
  S scale;
  /// Metres: the smaller of the two radii.
  S min_radius;
};

}  // namespace contactscope

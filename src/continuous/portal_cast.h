#pragma once

#include "continuous/approach.h"

namespace contactscope {

enum class CastStatus {
  Hit,        // the ray passes through the portal, a piece of the difference's surface
  Separated,  // a support plane separates the two until the end
  Undecided,  // the ray grazes the difference, or rounding hides on which side it passes
};

template <class S> struct CastLimits {
  S target = 0;  // metres: smaller separations do not count as separated
  S slack = 0;   // metres by which the portal may lie below the surface
  S until = 1;   // later times are not searched
};

/// A moving support plane of the difference: proves separation up to `time`.
template <class S> struct SupportPlane {
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, outward: from B to A
  S separation = 0;                   // along it at time 0, metres
  S time = 0;                         // when the separation falls to the target
};

/// Time of impact of two convex polyhedra that do not turn, with B moving relative to A: a ray cast
/// against the Minkowski difference B - A. The origin's path enters the difference through its
/// surface. The search finds three support points, the portal, that are a piece of that surface and
/// that the path passes through. Each support plane bounds the time until which the two are
/// separated, so the answer is never late, wherever the search ends.
///
/// The portal search follows Snethen, "XenoCollide: Complex Collision Made Simple", Game
/// Programming Gems 7, 2008, with the inner point moved to infinity along the ray. Clipping the ray
/// by every support plane is from van den Bergen, "Ray Casting against General Convex Objects with
/// Application to Continuous Collision Detection", 2004, which runs GJK at each clip; a portal
/// needs none. We deviate in the first support points: they are searched near the line of the
/// middles. The original searches across the path, on the outline, far from the impact.
///
/// Steps: 1. support point towards A's middle; 2. another on the other side of the path; 3. a
/// third, so that the path passes between the three; 4. support point along the portal's normal; 5.
/// done if it is beyond the portal by at most the slack; 6. else choose, of the three portals that
/// it forms with the sides, the one that the path passes through, and go to 4.
template <class S> class PortalCast {
 public:
  /// `scale` bounds all lengths, metres. The shapes must outlive this.
  PortalCast(const Turning<S>& a, const Turning<S>& b, S scale);

  /// Places the shapes in their orientations at a time of the step. `between`: B's pivot from A's
  /// at time 0 of the cast, metres. `offset`: its displacement until time 1, metres.
  void place(S time, const Vec3<S>& between, const Vec3<S>& offset);

  /// `planes`: receives the planes that increased the safe time; null: not recorded.
  CastStatus cast(const CastLimits<S>& limits, std::vector<SupportPlane<S>>* planes = nullptr);
  /// After place(): starts from the portal of the previous Hit if the path still passes through it.
  CastStatus cast_again(const CastLimits<S>& limits);

  /// Separated from 0 until this time.
  S safe_time() const { return safe_time_; }
  /// The last plane measured: of the portal for a Hit, else separating. Its time may be negative.
  const SupportPlane<S>& plane() const { return plane_; }
  /// Number of support points computed.
  int supports() const { return supports_; }

  /// After a Hit: the portal, weighted for the point that the path passes through. `a` and `b` of
  /// its vertices are arms from the pivots, rotated, metres.
  GjkSimplex<S> portal() const;
  /// After a Hit: closest points at a time near it. `axis` separates; time is set by the caller.
  Closest<S> closest(S time) const;

 private:
  /// A vertex of the difference and the vertices that form it. In units.
  struct Corner {
    int index_a, index_b;
    Vec3<S> arm_a, arm_b;  // from the pivots, rotated
    Vec3<S> point;         // at time 0 of the cast
  };

  Corner corner(int index_a, int index_b) const;
  /// Computes the support point along `outward`, any length > 0; true if its plane ends the search.
  bool measure(const Vec3<S>& outward, Corner& support);
  CastStatus discover();
  CastStatus refine();
  /// Its sign is the side of the path on which one point lies as seen from another.
  S side(const Corner& from, const Corner& to) const {
    return offset_.dot(from.point.cross(to.point));
  }
  GjkVertex<S> vertex(int i) const;

  const Turning<S>& a_;
  const Turning<S>& b_;
  S unit_ = 1, per_unit_ = 1;        // a power of two that keeps products within the range of S
  Mat3<S> rotation_a_, rotation_b_;  // from the shapes' frames, to units
  Vec3<S> between_, offset_;         // in units
  CastLimits<S> limits_;             // in units
  std::array<Corner, 3> corners_;    // of the portal, counter-clockwise seen from outside
  SupportPlane<S> plane_;
  S safe_time_ = 0;
  std::vector<SupportPlane<S>>* planes_ = nullptr;
  int supports_ = 0;
};

enum class SweptStatus {
  Separated,    // at no time of the step
  Hit,          // first at `time`
  Overlapping,  // at the start
};

constexpr const char* to_string(SweptStatus status) {
  constexpr const char* kNames[] = {"separated", "hit", "overlapping"};
  return kNames[static_cast<int>(status)];
}

enum class TriangleFeature { Face, Edge, Vertex };

constexpr const char* to_string(TriangleFeature feature) {
  constexpr const char* kNames[] = {"face", "edge", "vertex"};
  return kNames[static_cast<int>(feature)];
}

struct SweptSphereHit {
  SweptStatus status = SweptStatus::Separated;
  double time = 1;                                  // fraction of the step; 0 when Overlapping
  TriangleFeature feature = TriangleFeature::Face;  // the one met first, of a Hit
  int index = 0;                  // of the vertex, or of the vertex at which the edge begins
  Vec3d normal = Vec3d::UnitX();  // unit, from the triangle to the sphere's centre; of a Hit
  Vec3d point = Vec3d::Zero();    // on the triangle, relative to corner 0, metres; of a Hit
};

/// First impact of a moving sphere with a two-sided triangle at rest. `start`: centre at time 0,
/// `displacement`: in the step, metres, all in one frame. Flat triangles are treated as their
/// edges. For two moving bodies, pass the difference of their displacements.
///
/// The sphere's centre is cast against the triangle's rounded prism: two triangles at the radius
/// from the face, three cylinders about the edges, three balls about the vertices. The first one
/// hit is the answer, so edges and vertices are skipped if the face is hit inside the triangle.
/// Computed in double, relative to a corner: a float 1 km from the origin loses no more. Time and
/// place are accurate to some 1e-14 of the lengths, except for a path that touches the prism
/// without entering it, where rounding decides.
/// Source: Ericson 2005, section 5.5.6, a moving sphere's path against the prism.
template <class S>
SweptSphereHit sweep_sphere_triangle(const Vec3<S>& start, const Vec3<S>& displacement, S radius,
                                     const std::array<Vec3<S>, 3>& triangle);

}  // namespace contactscope

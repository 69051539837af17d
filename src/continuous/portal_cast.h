#pragma once

#include <array>
#include <vector>

#include "continuous/approach.h"

namespace contactscope {

enum class CastStatus {
  Hit,        // the way passes the portal, which is a piece of the difference's surface
  Separated,  // a support plane keeps the two apart until the end
  Undecided,  // the way grazes the difference, or rounding hides on which side it passes
};

/// What is asked of a cast.
template <class S>
struct CastLimits {
  S target = 0;  // metres: nearer than this is no longer apart
  S slack = 0;   // metres by which the portal may lie below the surface
  S until = 1;   // times from here on do not matter
};

/// A support plane of the difference that moves: up to `time` it says that the two are apart.
template <class S>
struct SupportPlane {
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, outward: from B to A
  S separation = 0;                   // along it at time 0, metres
  S time = 0;                         // when the separation falls to the target
};

/// When two convex polyhedra first meet that do not turn, of which B goes straight on beside A: a ray
/// against the Minkowski difference B - A. The origin's way enters the difference through its surface;
/// support points are looked for until three of them, the portal, are a piece of that surface which
/// the way passes. Each support plane on the way there says until when they are apart for certain, so
/// that the answer is never late, wherever the search ends.
///
/// The search for the portal is that of Snethen, "XenoCollide: Complex Collision Made Simple", Game
/// Programming Gems 7, 2008, with the inner point moved away along the ray to infinity. That every
/// support plane clips the ray is from van den Bergen, "Ray Casting against General Convex Objects
/// with Application to Continuous Collision Detection", 2004, who measures a distance by GJK at each
/// clip; a portal needs none. We deviate in the first support points: they are looked for beside the
/// line of the middles. Across the way, where the original looks, they lie on the outline, far from
/// the impact.
///
/// Steps: 1. the support point towards A's middle; 2. another beyond the way, as seen along it; 3. a
/// third, so that the way passes between the three; 4. the support point along the portal's normal;
/// 5. not beyond the portal by more than the slack: the end; 6. else of the three portals that it makes
/// with the sides, the one that the way passes, and go on at 4.
template <class S>
class PortalCast {
 public:
  /// `scale` bounds all lengths, metres. The shapes must outlive this.
  PortalCast(const Turning<S>& a, const Turning<S>& b, S scale);

  /// The shapes as they are turned at a time of their step, with B's pivot at `between` from A's at
  /// time 0 of the cast, metres, and `way` metres farther at time 1.
  void place(S time, const Vec3<S>& between, const Vec3<S>& way);

  /// `planes`: those that brought the safe time on are added; null when nobody watches.
  CastStatus cast(const CastLimits<S>& limits, std::vector<SupportPlane<S>>* planes = nullptr);
  /// After place(): begins with the portal of the search before, a Hit, if the way still passes it.
  CastStatus cast_again(const CastLimits<S>& limits);

  /// Until when they are apart, from 0 on.
  S safe_time() const { return safe_time_; }
  /// The last that was measured: of a Hit along the portal's normal, of Separated the one that says so.
  /// The time may be before 0.
  const SupportPlane<S>& plane() const { return plane_; }
  /// Support points looked for.
  int supports() const { return supports_; }

  /// Of a Hit: the portal, and as weights the point of it that the way passes. `a` and `b` of its
  /// vertices are arms from the pivots, turned, metres.
  GjkSimplex<S> portal() const;
  /// Of a Hit: the nearest points of both at a time of the cast, if it is near that of the hit.
  /// `axis` is the one along which they are apart, and Closest::time is left to the caller.
  Closest<S> closest(S time) const;

 private:
  /// A vertex of the difference, by those that it is made of. In units.
  struct Corner {
    int index_a, index_b;
    Vec3<S> arm_a, arm_b;  // from the pivots, turned
    Vec3<S> point;         // at time 0 of the cast
  };

  Corner corner(int index_a, int index_b) const;
  /// The support point along `outward`, any length > 0; true when its plane ends the search.
  bool measure(const Vec3<S>& outward, Corner& support);
  CastStatus discover();
  CastStatus refine();
  /// On which side of the way one point lies as seen from another: the sign.
  S side(const Corner& from, const Corner& to) const {
    return way_.dot(from.point.cross(to.point));
  }
  GjkVertex<S> vertex(int i) const;

  const Turning<S>& a_;
  const Turning<S>& b_;
  S unit_ = 1, per_unit_ = 1;        // a power of two, so that no product leaves the range of S
  Mat3<S> rotation_a_, rotation_b_;  // from the shapes' frames, to units
  Vec3<S> between_, way_;            // in units
  CastLimits<S> limits_;             // in units
  std::array<Corner, 3> corners_;    // of the portal, counter-clockwise seen from outside
  SupportPlane<S> plane_;
  S safe_time_ = 0;
  std::vector<SupportPlane<S>>* planes_ = nullptr;
  int supports_ = 0;
};

}  // namespace contactscope

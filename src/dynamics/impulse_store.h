#pragma once

#include <vector>

#include "dynamics/constraint.h"

/// Warm starting: Gregorius 2015, "Contact IDs"; Catto 2006, "Fast and Simple Physics using
/// Sequential Impulses". A manifold is made anew in each frame; a point that has the id of a point
/// before is the same point, and begins with what that one ended with.
namespace contactscope {

/// What the last step gave one point. Impulses on b, newton seconds, world.
template <class S>
struct PointImpulse {
  int triangle = -1;  // of a mesh; ids count within it
  FeatureId id;
  S normal = 0;  // of the last sub-step: where the next one begins
  Vec3<S> friction = Vec3<S>::Zero();
  S total_normal = 0;  // over the whole step
  Vec3<S> total_friction = Vec3<S>::Zero();
  S warm_start = 0;  // share of total_normal that it began with
};

/// Of one pair, in the order of its manifolds and their points.
template <class S>
using PairImpulses = std::vector<PointImpulse<S>>;

/// Each point begins with the impulse of its id; new points begin with zero. Where one id stands
/// several times, the first goes to the first. Friction is turned into the new contact plane.
template <class S>
void recall_impulses(const PairImpulses<S>& kept, ContactConstraint<S>& contact, int substeps);

/// Appends what the points of `contact` got.
template <class S>
void keep_impulses(const ContactConstraint<S>& contact, PairImpulses<S>& kept);

}  // namespace contactscope

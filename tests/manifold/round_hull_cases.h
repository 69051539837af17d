#pragma once

#include <vector>

#include "geometry/shape.h"
#include "manifold/dispatch.h"
#include "support/random_geometry.h"

/// A sphere or a capsule and a hull, and what is true of them by exhaustion.
namespace contactscope::test {

/// One point of the core makes a sphere about the origin of its frame, two make a capsule.
struct RoundHull {
  std::vector<Vec3d> core;  // own frame
  double radius;
  Pose<double> round_pose;
  Hull<double> hull;
  Pose<double> hull_pose;

  bool is_sphere() const { return core.size() == 1; }
  /// The length that rounding is relative to: both shapes with their frames, and the way between.
  double scale() const;
  /// World.
  Vec3d core_point(double parameter) const;
};

/// As the pipeline in S sees it: every number rounded once.
template <class S>
RoundHull rounded(const RoundHull& exact);

/// The one manifold, the round shape being A; without points when there is none.
template <class S>
Manifold<S> collide(const RoundHull& pair, const CollideOptions& options = {});

/// The distance of the core from the hull; in overlap minus the least translation that parts them.
/// Outside by brute_force_distance. Inside by every axis: the normals of all faces, from vertices,
/// and the cross products of the core with all edges, each measured by projecting everything.
double brute_force_separation(const RoundHull& pair);

/// The direction from the core's closest point to the hull's (world, unit), for cores outside.
Vec3d brute_force_normal(const RoundHull& pair);

/// The gap between the core's and the hull's projections on a unit direction (world) that points
/// from the core to the hull; negative in overlap.
double core_separation_along(const Vec3d& direction, const RoundHull& pair);

/// The distance of a point (world) from the hull, 0 inside.
double distance_from_hull(const Vec3d& point, const RoundHull& pair);

/// How far a vertex lies off the plane of one of its faces at most, metres: hulls merge faces that are
/// coplanar to single precision, and planes and vertices then tell of two bodies.
double unevenness(const Hull<double>& hull);

/// Boxes and hulls of 4 to 64 vertices, sizes over eight decades; flat and needle-like; the round
/// shape up to `ratio` times larger or smaller; outside, through the surface, and deep inside; over
/// faces, edges and vertices alike; the whole at a random pose.
RoundHull random_round_hull(Random& random, bool sphere, double ratio);

}  // namespace contactscope::test

#pragma once

#include <vector>

#include "geometry/shape.h"
#include "manifold/dispatch.h"
#include "support/random_geometry.h"

/// A sphere or a capsule and a hull, with oracles by exhaustion.
namespace contactscope::test {

/// One core point makes a sphere about the origin of its frame, two make a capsule.
struct RoundHull {
  std::vector<Vec3d> core;  // own frame
  double radius;
  Pose<double> round_pose;
  Hull<double> hull;
  Pose<double> hull_pose;

  bool is_sphere() const { return core.size() == 1; }
  /// The length that rounding is relative to: both shapes with their frames, plus their offset.
  double scale() const;
  /// In the world frame.
  Vec3d core_point(double parameter) const;
};

/// The input of the pipeline in S: every number rounded once.
template <class S> RoundHull rounded(const RoundHull& exact);

/// The one manifold, with the round shape as A; it has no points if there is no contact.
template <class S> Manifold<S> collide(const RoundHull& pair, const CollideOptions& options = {});

/// The distance of the core from the hull; in overlap, minus the least translation that separates
/// them. Outside, by brute_force_distance. Inside, by every axis: face normals from vertices, and
/// cross products of the core with all edges, each measured by projecting everything.
double brute_force_separation(const RoundHull& pair);

/// The direction from the core's closest point to the hull's (world, unit), for cores outside.
Vec3d brute_force_normal(const RoundHull& pair);

/// Separation of the core's and the hull's projections on a unit direction (world) that points from
/// the core to the hull; negative in overlap.
double core_separation_along(const Vec3d& direction, const RoundHull& pair);

/// Distance of a point (world) from the hull, 0 inside.
double distance_from_hull(const Vec3d& point, const RoundHull& pair);

/// Largest distance of a vertex from the plane of one of its faces, metres. Hulls merge faces that
/// are coplanar to single precision, so planes and vertices describe slightly different bodies.
double unevenness(const Hull<double>& hull);

/// Boxes and hulls of 4 to 64 vertices, sizes over eight decades, flat and needle-like ones too.
/// The round shape is up to `ratio` times larger or smaller; outside, through the surface, or deep
/// inside; over faces, edges and vertices. The whole pair is at a random pose.
RoundHull random_round_hull(Random& random, bool sphere, double ratio);

}  // namespace contactscope::test

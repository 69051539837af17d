#pragma once

#include "geometry/shape.h"
#include "support/random_geometry.h"

/// Spheres and capsules against each other and against hulls, with an oracle.
namespace contactscope::peers {

struct RoundPair {
  Shape<double> a;
  Pose<double> pose_a;
  Shape<double> b;
  Pose<double> pose_b;
};

/// Radius and half height 0.1 to 0.5 m, hulls 0.2 to 1 m; from slightly separated to deep. The
/// whole pair is at a random pose, rounded to float. Neither kind may be a plane or a mesh.
RoundPair random_round_pair(ShapeKind a, ShapeKind b, test::Random& random);

/// Metres along the direction of least overlap, or the distance; by exhaustion.
double separation_by_exhaustion(const RoundPair& pair);

/// Separation of the projections of both on a unit direction from A to B, world.
double separation_along(const Vec3d& direction, const RoundPair& pair);

/// Radius, 0 for a hull.
double radius_of(const Shape<double>& shape);

/// Metres: both shapes plus their offset.
double length_scale(const RoundPair& pair);

}  // namespace contactscope::peers

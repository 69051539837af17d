#pragma once

#include <vector>

#include "core/plane.h"
#include "core/vec3.h"
#include "draw/scene/camera.h"

namespace contactscope::draw {

/// A sphere or a capsule in the world: all that is within a radius of a point or a segment. Its
/// outward normals name its surface points: where the normal is n, the surface is at p + radius n,
/// p being the end of the core that is farthest along n.
struct RoundBody {
  std::vector<Vec3d> core;  // one point or two, metres
  double radius = 0;

  /// Where the view rays touch the surface, in order around it: a circle for a sphere, two arcs
  /// joined by straight lines for a capsule, or one circle where a capsule is seen end on. Empty
  /// for an eye inside of the body.
  std::vector<Vec3d> outline(const Camera& camera) const;

  struct Facet {
    std::vector<Vec3d> polygon;  // world, corners on the surface
    double lit = 0;              // cosine of its middle to the light
  };
  /// What the eye sees of the surface, in facets so small that nobody sees them. No facet crosses
  /// a border between two tones, nor the outline.
  std::vector<Facet> front(const Camera& camera, const Vec3d& light) const;

  /// The body hides what is behind all of these planes (normal . x <= offset): a convex body's
  /// shadow is convex, and bounded by the planes that touch the body on its front and along its
  /// outline.
  std::vector<Plane<double>> shadow(const Camera& camera) const;
};

/// The plane on which points have equal power over two bodies, normal from `a` to `b`: it parts
/// them where they are apart, and goes through the curve in which two spheres meet.
Plane<double> power_plane(const RoundBody& a, const RoundBody& b);

}  // namespace contactscope::draw

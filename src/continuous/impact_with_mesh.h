#pragma once

#include <array>

#include "continuous/impact_of_shapes.h"

namespace contactscope {

/// A mesh, each of its triangles with two sides, and a convex shape: impact_of_shapes() for these two.
/// `run` records the search against the triangle that is met first, where it is not exact.
template <class S>
ShapeImpact<S> impact_with_mesh(const Mesh<S>& mesh, const Sweep<S>& of_mesh,
                                const MovingShape<S>& shape, ImpactMethod method,
                                ImpactLimits<S> allowed, ImpactRun<S>* run);

/// Two meshes that keep their form: triangle against triangle, where the boxes that they sweep overlap.
/// Unlike impact_of_meshes() it follows turns exactly.
template <class S>
ShapeImpact<S> impact_of_rigid_meshes(const Mesh<S>& a, const Sweep<S>& of_a, const Mesh<S>& b,
                                      const Sweep<S>& of_b, ImpactMethod method,
                                      ImpactLimits<S> allowed, ImpactRun<S>* run);

/// Of a triangle, in the mesh's frame.
template <class S>
std::array<Vec3<S>, 3> corners_of(const Mesh<S>& mesh, int triangle) {
  return {mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)};
}

/// Refers to the corners.
template <class S>
MovingShape<S> moving_triangle(const std::array<Vec3<S>, 3>& corners, const Sweep<S>& motion) {
  return {{corners.data(), 3, nullptr}, motion, 0};
}

template <class A, class S>
ImpactResult<S> impact_by(ImpactMethod method, const A& a, const MovingShape<S>& b,
                          const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  return method == ImpactMethod::ConservativeAdvancement
             ? conservative_advancement(a, b, allowed, run)
             : time_of_impact(a, b, allowed, run);
}

}  // namespace contactscope

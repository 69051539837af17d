#pragma once

#include <array>

#include "continuous/impact_of_shapes.h"

namespace contactscope {

/// impact_of_shapes() for a mesh of two-sided triangles and a convex shape. `run` records the
/// search against the triangle that is met first, unless it is exact. Corners are read in the
/// mesh's scalar, all else is computed in double.
template <class S>
ShapeImpact<double> impact_with_mesh(const Mesh<S>& mesh, const Sweep<double>& of_mesh,
                                     const MovingShape<double>& shape, ImpactMethod method,
                                     ImpactLimits<double> allowed, ImpactRun<double>* run);

/// Two rigid meshes: triangle against triangle where their swept boxes overlap. Unlike
/// impact_of_meshes() it follows rotations exactly.
template <class S>
ShapeImpact<double> impact_of_rigid_meshes(const Mesh<S>& a, const Sweep<double>& of_a,
                                           const Mesh<S>& b, const Sweep<double>& of_b,
                                           ImpactMethod method, ImpactLimits<double> allowed,
                                           ImpactRun<double>* run);

/// Corners of a triangle, in the mesh's frame.
template <class S> std::array<Vec3d, 3> corners_of(const Mesh<S>& mesh, int triangle) {
  const auto corner = [&](int k) -> Vec3d {
    return mesh.corner(triangle, k).template cast<double>();
  };
  return {corner(0), corner(1), corner(2)};
}

/// Refers to the corners.
inline MovingShape<double> moving_triangle(const std::array<Vec3d, 3>& corners,
                                           const Sweep<double>& motion) {
  return {{corners.data(), 3, nullptr}, motion, 0};
}

template <class A>
ImpactResult<double> impact_by(ImpactMethod method, const A& a, const MovingShape<double>& b,
                               const ImpactLimits<double>& allowed, ImpactRun<double>* run) {
  return method == ImpactMethod::ConservativeAdvancement
             ? conservative_advancement(a, b, allowed, run)
             : time_of_impact(a, b, allowed, run);
}

}  // namespace contactscope

#pragma once

#include "continuous/impact_of_shapes.h"
#include "continuous/moving_features.h"

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

/// A mesh that deforms or moves in a step, each vertex on a straight line. Refers to its data.
template <class S> struct MovingMesh {
  const Mesh<S>& start;          // vertices and tree at time 0
  std::span<const Vec3<S>> end;  // vertices at time 1, in the same frame, metres
};

/// Cost of the search.
struct MeshImpactCounts {
  std::int64_t node_pairs = 0;      // swept boxes of nodes tested against each other
  std::int64_t triangle_pairs = 0;  // triangles whose swept boxes overlap before the best time
  std::int64_t feature_pairs = 0;   // vertex-face and edge-edge tests of those triangles
};

struct MeshImpact {
  FeatureImpact impact;                  // the first one
  int triangle_a = -1, triangle_b = -1;  // of these features; -1 when Separated
  /// Corner 0 to 2 of the triangle, or its edge from that corner on. -1 for the face of the
  /// triangle; both -1 for triangles that overlap at the start.
  int feature_a = -1, feature_b = -1;
  bool is_edges = false;  // else vertex-face or face-vertex
  MeshImpactCounts counts;
};

/// The first time in a step at which two deforming meshes meet, both in one frame. Never late, like impact_of_vertex_face() and impact_of_edges(): triangles that are
/// separated at the start first meet at such features. Triangles that share a point at the start
/// (an exact test) are Overlapping, whatever comes later. A Near before every Hit is returned. Both
/// meshes need one end per vertex.
///
/// A node's box, interpolated from start to end, contains its triangles at every time. Nodes that
/// overlap first are visited first, up to the best time. Shared vertices and edges are tested once:
/// one of their triangles owns them (Curtis, Tamstorf and Manocha 2008, "Fast Collision Detection
/// for Deformable Models Using Representative-Triangles").
template <class S> MeshImpact impact_of_meshes(const MovingMesh<S>& a, const MovingMesh<S>& b);

}  // namespace contactscope

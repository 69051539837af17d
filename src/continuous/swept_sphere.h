#pragma once

#include <array>

#include "core/vec3.h"

namespace contactscope {

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

#pragma once

#include <array>

#include "core/vec3.h"

namespace contactscope {

enum class SweptStatus {
  Separated,    // at no time of the step
  Hit,          // first at `time`
  Overlapping,  // at the start already
};

/// "separated", "hit", "overlapping".
constexpr const char* to_string(SweptStatus status) {
  constexpr const char* kNames[] = {"separated", "hit", "overlapping"};
  return kNames[static_cast<int>(status)];
}

enum class TriangleFeature { Face, Edge, Vertex };

/// "face", "edge", "vertex".
constexpr const char* to_string(TriangleFeature feature) {
  constexpr const char* kNames[] = {"face", "edge", "vertex"};
  return kNames[static_cast<int>(feature)];
}

struct SweptSphereHit {
  SweptStatus status = SweptStatus::Separated;
  double time = 1;                                  // fraction of the step; 0 when Overlapping
  TriangleFeature feature = TriangleFeature::Face;  // the first that is met; of a Hit
  int index = 0;                  // of the vertex, or of the one that the edge begins at
  Vec3d normal = Vec3d::UnitX();  // unit, from the triangle to the sphere's centre; of a Hit
  Vec3d point = Vec3d::Zero();    // of the triangle, relative to corner 0, metres; of a Hit
};

/// When a sphere that goes straight on first meets a triangle that stands still; of both sides alike.
/// `start` is the sphere's centre at time 0, `displacement` its way in the step, metres, all in one
/// frame. Flat triangles are their edges. What two moving bodies do is the same with the difference of
/// their ways.
///
/// What the sphere's centre must not enter is the triangle's rounded prism: two triangles at the
/// radius over the face, three cylinders about the edges, three balls about the vertices. The first
/// of these that the centre's way meets is the answer, so none is solved for where the face's is
/// met inside the triangle. All in double, relative to a corner: a float 1 km from the origin has
/// lost nothing more. Time and place are right to some 1e-14 of the lengths, but for a way that
/// touches the prism and does not enter it, where rounding decides.
/// Source: Ericson 2005, section 5.5.6, says the sphere's way against the prism.
template <class S>
SweptSphereHit sweep_sphere_triangle(const Vec3<S>& start, const Vec3<S>& displacement, S radius,
                                     const std::array<Vec3<S>, 3>& triangle);

}  // namespace contactscope

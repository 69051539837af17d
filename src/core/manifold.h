#pragma once

#include <cstddef>

#include "core/feature_id.h"
#include "core/static_vector.h"
#include "core/vec3.h"

namespace contactscope {

/// Most vertices that one face of a hull may have; the hull builder refuses more. It bounds the
/// clip polygon: every side plane of the reference face adds at most one vertex.
inline constexpr std::size_t kMaxFaceVertices = 128;
inline constexpr std::size_t kMaxManifoldPoints = 2 * kMaxFaceVertices;

/// Gregorius 2015, "Contact Points".
template <class S>
struct ContactPoint {
  Vec3<S> position;  // world, metres
  S separation;      // metres along the normal; negative = overlap
  FeatureId id;
};

/// Which axis of the separating axis test made the manifold.
enum class AxisKind { FaceA, FaceB, EdgeEdge };

/// "face_a", "face_b", "edge_edge", as traces spell it.
constexpr const char* to_string(AxisKind kind) {
  switch (kind) {
    case AxisKind::FaceA:
      return "face_a";
    case AxisKind::FaceB:
      return "face_b";
    case AxisKind::EdgeEdge:
      return "edge_edge";
  }
  return "?";
}

/// Gregorius 2015, "Contact Manifolds": contact points that share a normal. Empty when the shapes
/// are apart by more than the margin, never empty when they overlap.
template <class S>
struct Manifold {
  Vec3<S> normal = Vec3<S>::Zero();  // world, unit, from A to B
  AxisKind axis = AxisKind::FaceA;
  StaticVector<ContactPoint<S>, kMaxManifoldPoints> points;
};

}  // namespace contactscope

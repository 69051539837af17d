#pragma once

#include "core/feature_id.h"
#include "core/static_vector.h"
#include "core/vec3.h"

namespace contactscope {

/// Maximum number of vertices of a hull's face; the hull builder rejects more. It bounds the clip
/// polygon: every side plane of the reference face adds at most one vertex.
inline constexpr std::size_t kMaxFaceVertices = 128;
inline constexpr std::size_t kMaxManifoldPoints = 2 * kMaxFaceVertices;

/// Gregorius 2015, "Contact Points".
template <class S> struct ContactPoint {
  Vec3<S> position;  // world, metres
  S separation;      // metres along the normal; negative = overlap
  FeatureId id;
};

/// Source of the normal: an axis of the separating axis test, or the closest points of two shapes
/// whose cores are separated (Gregorius 2015, "Shallow Contact" and "Deep Contact").
enum class AxisKind { FaceA, FaceB, EdgeEdge, ClosestPoints };

/// "face_a", "face_b", "edge_edge", "closest_points", as written in traces.
constexpr const char* to_string(AxisKind kind) {
  constexpr const char* kNames[] = {"face_a", "face_b", "edge_edge", "closest_points"};
  return kNames[static_cast<int>(kind)];
}

/// The same axis after the shapes are swapped.
constexpr AxisKind mirrored(AxisKind kind) {
  if (kind == AxisKind::FaceA) return AxisKind::FaceB;
  if (kind == AxisKind::FaceB) return AxisKind::FaceA;
  return kind;
}

/// Which axis of the separating axis test wins when several are nearly as deep.
enum class Preference {
  /// Faces of A before faces of B before edge pairs; on meshes the triangle's face comes first. The
  /// preferred axis wins while it is deeper by at most 5% of the depth or 0.2% of the smaller
  /// hull's radius, whichever is larger, and its deepest point is at least 95% as deep as the
  /// overlap. An edge contact has one point, and features that change between frames break warm
  /// starting. Catto 2007, "Feature Flip-Flop"; Gregorius 2015, "Hull vs Hull: Feature Flip-Flop".
  Relative,
  /// The axis of minimum penetration.
  None,
};

/// "relative", "none", as written in scenarios and traces.
constexpr const char* to_string(Preference preference) {
  return preference == Preference::Relative ? "relative" : "none";
}

/// Algorithm for the depth and normal of two overlapping hulls (Gregorius 2015, "Building
/// Incremental Manifolds (1)"; Catto 2007, "Deep Contact").
enum class PenetrationMethod {
  Sat,       // all relevant axes: exact
  Epa,       // expanding polytope (van den Bergen 2001)
  Mpr,       // Minkowski portal refinement (Snethen 2008)
  Sampling,  // brute force over directions
};

/// "sat", "epa", "mpr", "sampling", as written in scenarios and traces.
constexpr const char* to_string(PenetrationMethod method) {
  constexpr const char* kNames[] = {"sat", "epa", "mpr", "sampling"};
  return kNames[static_cast<int>(method)];
}

/// Features of the two shapes that touch, the simpler one first (lecture on contact generation,
/// "Contact types"). A round shape has its centre or axis ends as points, its axis as edge.
enum class ContactType { PointPoint, PointEdge, PointFace, EdgeEdge, EdgeFace, FaceFace };

/// "point-face", as written in traces.
constexpr const char* to_string(ContactType type) {
  constexpr const char* kNames[] = {"point-point", "point-edge", "point-face",
                                    "edge-edge",   "edge-face",  "face-face"};
  return kNames[static_cast<int>(type)];
}

constexpr ContactType contact_type(FeatureKind one, FeatureKind two) {
  using enum ContactType;
  constexpr ContactType kTypes[3][3] = {{PointPoint, PointEdge, PointFace},
                                        {PointEdge, EdgeEdge, EdgeFace},
                                        {PointFace, EdgeFace, FaceFace}};
  return kTypes[static_cast<int>(one)][static_cast<int>(two)];
}

/// Type of a contact for which clipping against a face gave `points` points, before reduction.
constexpr ContactType face_contact_type(std::size_t points) {
  if (points == 1) return ContactType::PointFace;
  return points == 2 ? ContactType::EdgeFace : ContactType::FaceFace;
}

/// Gregorius 2015, "Contact Manifolds": contact points that share a normal. Empty when the
/// separation exceeds the margin; not empty in overlap, unless degenerate and to be skipped.
template <class S> struct Manifold {
  // Not "= default": with an empty body, Manifold() leaves the storage of the points uninitialised.
  // Otherwise it would clear eight kilobytes.
  Manifold() {}  // NOLINT(modernize-use-equals-default)

  Vec3<S> normal = Vec3<S>::Zero();  // world, unit, from A to B
  AxisKind axis = AxisKind::FaceA;
  ContactType type = ContactType::FaceFace;
  int triangle = -1;  // mesh triangle of the manifold; -1: of a whole pair
  StaticVector<ContactPoint<S>, kMaxManifoldPoints> points;
};

}  // namespace contactscope

#pragma once

#include <string>
#include <vector>

#include "manifold.h"
#include "shape.h"
#include "trace.h"

namespace contactscope::package {

struct CollideOptions {
  Scalar scalar = Scalar::Double;
  double margin = 0;  // metres; points up to this separation are kept
  /// As `contactscope list reducers` has them, see reduce.h; "none" keeps every point.
  std::string reducer = "optimal_deepest";
  int max_points = 4;  // of a manifold, >= 1
  /// How deep two hulls that overlap are is found by: "sat", "epa", "mpr" or "sampling".
  std::string penetration = "sat";
  /// What each stage decided is told too, in Contacts::trace. It changes no bit of the result.
  bool record = false;
  std::string name_a = "a", name_b = "b";  // in that trace; not empty, and not the same
};

enum class ContactStatus {
  Touching,
  Separated,  // by more than the margin
  /// Two planes, a plane and a mesh, or two meshes: they make no contacts.
  NoSuchPair,
  /// A pose with a number that is not finite, or a quaternion of zero length.
  NotFinite,
};

/// "touching", "separated", "no such pair", "not finite".
const char* to_string(ContactStatus status);

struct Contacts {
  ContactStatus status = ContactStatus::Separated;
  std::vector<Manifold> manifolds{};  // one for convex shapes, one a triangle for meshes
  /// Metres of the deepest point. Where they are apart: along the best axis when it was recorded,
  /// else 0.
  double separation = 0;
  Trace trace{};  // of one frame, where it was recorded; else empty
};

/// Contacts of two shapes placed in the world; normals point from a to b. Geometry without a normal of
/// its own, as spheres about one place, gets one that is as good as any other. Throws std::invalid_argument
/// for an option that there is not, with those that there are.
Contacts collide(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                 const CollideOptions& options = {});

}  // namespace contactscope::package

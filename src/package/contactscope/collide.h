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
  /// A name from `contactscope list reducers`, see reduce.h; "none" keeps every point.
  std::string reducer = "optimal_deepest";
  int max_points = 4;  // per manifold, >= 1
  /// Penetration depth of overlapping hulls: "sat", "epa", "mpr" or "sampling".
  std::string penetration = "sat";
  /// Records the decision of each stage in Contacts::trace. Does not change the result.
  bool record = false;
  std::string name_a = "a", name_b = "b";  // in that trace; not empty, different
};

enum class ContactStatus {
  Touching,
  Separated,  // by more than the margin
  /// No contacts are defined for two planes, a plane and a mesh, or two meshes.
  NoSuchPair,
  /// A pose has a number that is not finite or a quaternion of zero length.
  NotFinite,
};

/// "touching", "separated", "no such pair", "not finite".
const char* to_string(ContactStatus status);

struct Contacts {
  ContactStatus status = ContactStatus::Separated;
  std::vector<Manifold> manifolds{};  // one for convex shapes; one per direction for meshes
  /// Separation of the deepest point, metres. Separated: along the best recorded axis, else 0.
  double separation = 0;
  Trace trace{};  // one frame if `record` was set, else empty
};

/// Contacts of two shapes in world space; normals point from a to b. Degenerate cases without a
/// unique normal, such as concentric spheres, get an arbitrary one. Throws std::invalid_argument
/// for an invalid option; the message lists the valid ones.
Contacts collide(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                 const CollideOptions& options = {});

}  // namespace contactscope::package

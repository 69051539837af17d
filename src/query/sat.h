#pragma once

#include "core/manifold.h"
#include "core/pose.h"
#include "geometry/hull.h"

namespace contactscope {

/// Best face of one hull against the other hull. Separation in metres: the distance of the other
/// hull's support vertex from the face plane, negative in overlap.
template <class S>
struct FaceQuery {
  int face = -1;
  int support = -1;  // vertex of the other hull, deepest below the face
  S separation;
};

/// Best edge pair that forms a face of the Minkowski difference.
template <class S>
struct EdgeQuery {
  int edge_a = -1;  // half-edges; -1 when no pair of edges forms a Minkowski face
  int edge_b = -1;
  S separation;
  Vec3<S> normal;  // unit, from A to B, in A's frame
};

enum class SatStatus {
  Separated,  // `chosen` names the first axis found with separation > margin
  Touching,   // `chosen` names the axis that makes the contact
};

}  // namespace contactscope

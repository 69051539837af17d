#pragma once

#include <optional>

#include "lint/solid.h"
#include "manifold/dispatch.h"

namespace contactscope::lint {

/// What this program's own pipeline finds of two solids, which best_separation() does not know of meshes.
struct OwnContacts {
  Manifolds<double> manifolds;  // with all points; without the rounding of hulls
  double separation = 0;  // metres, of the deepest point, rounding and all; infinite without points
};

/// At their own scale. Empty of two kinds of shapes that do not collide here.
std::optional<OwnContacts> own_contacts(const Placed& a, const Placed& b);

}  // namespace contactscope::lint

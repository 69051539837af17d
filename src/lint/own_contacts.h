#pragma once

#include <optional>

#include "lint/solid.h"
#include "manifold/dispatch.h"

namespace contactscope::lint {

/// Contacts from our own pipeline, for meshes, which best_separation() does not support.
struct OwnContacts {
  Manifolds<double> manifolds;  // all points; hulls without rounding
  double separation = 0;  // metres, of the deepest point, with rounding; infinite without points
};

/// At their own scale. Empty for kinds of shapes that do not collide here.
std::optional<OwnContacts> own_contacts(const Placed& a, const Placed& b);

/// For shapes of any kind; empty if it cannot be computed, as for two meshes. For a mesh the normal
/// is zero, and the distance is infinite if nothing touches it.
std::optional<Separation> separation_of(const Placed& a, const Placed& b);

}  // namespace contactscope::lint

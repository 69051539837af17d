#pragma once

#include "geometry/capsule.h"
#include "geometry/mesh.h"
#include "manifold/contact_sink.h"

namespace contactscope {

/// Gregorius 2015, "Mesh Contacts": the capsule against each triangle that its box touches, as
/// against a flat hull; see collide_with_triangles.h. A segment that lies in the plane of a triangle
/// beside it, where no axis of the separating axis test looks, meets it at the closest points of
/// segment and outline. Returns the least separation in metres.
template <class S>
S collide_capsule_mesh(const Capsule<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions<S>& options, ContactSink<S>& sink,
                       Recorder<S>* recorder);

}  // namespace contactscope

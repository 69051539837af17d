#pragma once

#include "geometry/mesh.h"
#include "geometry/sphere.h"
#include "manifold/contact_sink.h"

namespace contactscope {

/// Gregorius 2015, "Mesh Contacts": a contact for each triangle that the sphere touches, at the
/// triangle's closest point to the centre; see collide_with_triangles.h. Triangles have two sides: a
/// centre behind one is pushed out at the back. A centre on a triangle or its outline, within
/// rounding, has no normal: the fallback, see Degenerate, is that of the front. Returns the least
/// separation in metres.
template <class S>
S collide_sphere_mesh(const Sphere<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                      const CollideOptions<S>& options, ContactSink<S>& sink,
                      Recorder<S>* recorder);

}  // namespace contactscope

#pragma once

#include "geometry/hull.h"
#include "geometry/mesh.h"
#include "manifold/contact_sink.h"

namespace contactscope {

/// Gregorius 2015, "Mesh Contacts": the hull against each triangle that its box touches, as two
/// hulls, of which one is flat; see collide_with_triangles.h. Returns the least separation in
/// metres.
template <class S>
S collide_hull_mesh(const Hull<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                    const CollideOptions<S>& options, ContactSink<S>& sink, Recorder<S>* recorder);

}  // namespace contactscope

#pragma once

#include <vector>

#include "package/facts.h"

namespace contactscope::package {

/// A trace of one frame that has these manifolds, and for their shapes stand-ins, so that a picture can
/// be drawn where nobody told the shapes: "a" is the plane of the first manifold, through the middle of its points,
/// and "b" the outline of all points on that plane, or a thin capsule or small ball about one or two.
contactscope::trace::Trace with_stand_ins(const std::vector<Manifold>& manifolds, Scalar scalar);

}  // namespace contactscope::package

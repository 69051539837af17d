#pragma once

#include <vector>

#include "package/facts.h"

namespace contactscope::package {

/// A trace of one frame with these manifolds and stand-ins for unknown shapes, to be drawn. "a" is
/// the plane of the first manifold through the mean of its points. "b" is the outline of all points
/// on that plane; for two points a thin capsule, for one a small ball.
contactscope::trace::Trace with_stand_ins(const std::vector<Manifold>& manifolds, Scalar scalar);

}  // namespace contactscope::package

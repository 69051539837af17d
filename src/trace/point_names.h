#pragma once

#include "trace/trace.h"

namespace contactscope::trace {

/// Gives the points of pairs in which no point has an id ids made up from geometry, spelled as ours are (see
/// FeatureId): the two edges that cross in the point as seen along the normal, or the feature of each
/// shape that it lies on. So the points of an engine that tells no ids can be followed from frame to
/// frame. `shapes` must hold all shapes of the frame, with faces and edges. Points on a distance field
/// keep none; a mesh of which no triangle is told is searched for the one that is met, where it has 20,000 at most.
void name_points(const std::vector<Shape>& shapes, Frame& frame);

}  // namespace contactscope::trace

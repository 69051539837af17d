#pragma once

#include "trace/shape.h"

namespace contactscope::draw {

/// Polygons for a convex shape that is rounded by a margin: faces moved outwards, strips around
/// edges and caps around vertices, which are not quite flat. All corners are on the round surface;
/// strips are inside it by at most 2 % of the margin. The result has no margin.
trace::Shape rounded(const trace::Shape& shape);

}  // namespace contactscope::draw

#pragma once

#include "trace/shape.h"

namespace contactscope::draw {

/// A convex shape that is rounded by a margin, as polygons: its faces, moved out, strips around its edges and caps,
/// not quite flat, around its vertices. All corners are on the round surface; strips are inside of it by 2 % of the
/// margin at most. The result has no margin.
trace::Shape rounded(const trace::Shape& shape);

}  // namespace contactscope::draw

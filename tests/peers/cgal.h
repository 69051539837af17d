#pragma once

#include "query/triangle_overlap.h"

namespace contactscope::peers {

/// CGAL's test whether two closed triangles share a point, with its kernel of exact predicates and
/// inexact constructions. Precondition of CGAL: both triangles have an area.
bool cgal_overlaps(const Triangle<double>& a, const Triangle<double>& b);

}  // namespace contactscope::peers

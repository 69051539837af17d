#pragma once

#include "query/triangle_overlap.h"

namespace contactscope::peers {

/// CGAL's answer, with its kernel of exact predicates and inexact constructions, whether two closed
/// triangles share a point. Both have an area: CGAL makes that a precondition.
bool cgal_overlaps(const Triangle<double>& a, const Triangle<double>& b);

}  // namespace contactscope::peers

#include "peers/cgal.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>

namespace contactscope::peers {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Triangle_3 cgal_triangle(const Triangle<double>& t) {
  const auto point = [](const Vec3d& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  return {point(t[0]), point(t[1]), point(t[2])};
}

}  // namespace

bool cgal_overlaps(const Triangle<double>& a, const Triangle<double>& b) {
  return CGAL::do_intersect(cgal_triangle(a), cgal_triangle(b));
}

}  // namespace contactscope::peers

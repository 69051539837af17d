#include "draw/scene/kept_area.h"

#include <algorithm>

#include "core/at.h"
#include "core/convex_polygon.h"
#include "core/vec3.h"

namespace contactscope::draw {

std::vector<Vec3d> kept_polygon(const trace::Reduction& reduction, const Vec3d& normal) {
  const Vec3d u = any_perpendicular(normal), v = normal.cross(u);
  const auto flat = [&](int i) -> Vec2d {
    const Vec3d& place = at(reduction.points, i).position;
    return {u.dot(place), v.dot(place)};
  };
  std::vector<Vec3d> corners;
  for (const Vec2d& corner : convex_polygon(mapped(reduction.kept, flat))) {
    const auto found = std::ranges::find(reduction.kept, corner, flat);
    corners.push_back(at(reduction.points, *found).position);
  }
  return corners;
}

}  // namespace contactscope::draw

#include "draw/scene/view_fit.h"

#include <algorithm>
#include <cmath>

namespace contactscope::draw {

ViewAxes::ViewAxes(const Vec3d& direction, const Vec3d& world_up) : towards_eye(direction) {
  right = world_up.cross(direction);
  right = right.norm() > 1e-6 ? Vec3d(right.normalized()) : any_perpendicular(direction);
  up = direction.cross(right);
}

Vec3d center_of(const std::vector<Vec3d>& points) {
  Vec3d low = points.front(), high = points.front();
  for (const Vec3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return 0.5 * (low + high);
}

// A point at (x, y, z) in the camera's axes is seen at x / (distance - z), so each asks for
// distance >= z + |x| / (share * tangent of the half angle).
ViewFit fit_view(const std::vector<Vec3d>& points, const ViewAxes& axes,
                 const std::optional<Vec3d>& target, double half_height, double aspect,
                 double share) {
  ViewFit result{target.value_or(center_of(points)), 0};
  for (int round = 0; round < 4; ++round) {
    double distance = 0;
    for (const Vec3d& p : points) {
      const Vec3d q = p - result.target;
      const double side = std::max(std::abs(q.dot(axes.up)) / half_height,
                                   std::abs(q.dot(axes.right)) / (half_height * aspect));
      distance = std::max(distance, q.dot(axes.towards_eye) + side / share);
    }
    result.distance = distance;
    if (target || distance <= 0) return result;
    double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
    for (const Vec3d& p : points) {
      const Vec3d q = p - result.target;
      const double depth = std::max(distance - q.dot(axes.towards_eye), 1e-6 * distance);
      low_x = std::min(low_x, q.dot(axes.right) / depth);
      high_x = std::max(high_x, q.dot(axes.right) / depth);
      low_y = std::min(low_y, q.dot(axes.up) / depth);
      high_y = std::max(high_y, q.dot(axes.up) / depth);
    }
    result.target += 0.5 * distance * ((low_x + high_x) * axes.right + (low_y + high_y) * axes.up);
  }
  return result;
}

}  // namespace contactscope::draw

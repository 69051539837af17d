#include "dynamics/rest.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/at.h"
#include "core/convex_polygon.h"

namespace contactscope {
namespace {

/// The contact plane, with the mean of the points as origin.
PlaneFrame<double> contact_plane(std::span<const Vec3d> points, const Vec3d& normal) {
  Vec3d middle = Vec3d::Zero();
  for (const Vec3d& point : points) middle += (point - points[0]) / double(points.size());
  return {Vec3d(middle + points[0]), normal};
}

struct BorderPoint {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t edge = 0;  // from corner `edge` to the next
  bool corner = false;   // the nearest point is an end of it
};

/// Rounds margins within rounding to zero.
double beyond_rounding(double margin, double rounding) {
  return std::abs(margin) <= rounding ? 0 : margin;
}

BorderPoint nearest_on_border(const std::vector<Vec2d>& corners, const Vec2d& point,
                              double rounding) {
  BorderPoint nearest;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2d along = corners[(i + 1) % corners.size()] - corners[i];
    const Vec2d offset = point - corners[i];
    const double length = along.norm();
    const double at = offset.dot(along) / length;
    const Vec2d foot = corners[i] + std::clamp(at, 0.0, length) / length * along;
    const double distance = Vec2d(point - foot).norm();
    if (distance >= nearest.distance) continue;
    nearest = {distance, i, at < -rounding || at > length + rounding};
  }
  return nearest;
}

bool is_inside(const std::vector<Vec2d>& corners, const Vec2d& point) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2d along = corners[(i + 1) % corners.size()] - corners[i];
    if (cross(along, Vec2d(point - corners[i])) < 0) return false;
  }
  return true;
}

/// The two corners that are farthest from each other.
std::array<Vec2d, 2> ends_of(const std::vector<Vec2d>& corners) {
  std::array<Vec2d, 2> ends{corners[0], corners[0]};
  for (const Vec2d& one : corners)
    for (const Vec2d& other : corners)
      if ((other - one).squaredNorm() > (ends[1] - ends[0]).squaredNorm()) ends = {one, other};
  return ends;
}

/// Largest distance of the corners from a line.
double width_of(const std::vector<Vec2d>& corners, const std::array<Vec2d, 2>& ends) {
  const Vec2d along = ends[1] - ends[0];
  double width = 0;
  for (const Vec2d& corner : corners)
    width = std::max(width, std::abs(cross(along, Vec2d(corner - ends[0]))) / along.norm());
  return width;
}

}  // namespace

double rounding_of(std::span<const Vec3d> points, const Vec3d& center_of_mass, double epsilon) {
  double largest = center_of_mass.cwiseAbs().maxCoeff();
  for (const Vec3d& point : points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return 64 * epsilon * largest;
}

trace::Stability rest_of(std::span<const Vec3d> points, const Vec3d& normal,
                         const Vec3d& center_of_mass, double rounding) {
  trace::Stability result;
  result.center_of_mass = result.projection = center_of_mass;
  result.verdict = "no contact";
  if (points.empty()) return result;
  const PlaneFrame<double> plane = contact_plane(points, normal);
  const Vec2d projection = plane.seen(center_of_mass);
  result.projection = plane.place(projection);
  const std::vector<Vec2d> corners =
      convex_polygon(mapped(points, [&](const Vec3d& point) { return plane.seen(point); }));
  for (const Vec2d& corner : corners) result.support.push_back(plane.place(corner));

  const std::array<Vec2d, 2> ends = ends_of(corners);
  if ((ends[1] - ends[0]).norm() <= rounding) {
    result.verdict = "turns about a point";
    result.margin = beyond_rounding(-Vec2d(projection - corners[0]).norm(), rounding);
    return result;
  }
  const BorderPoint border = nearest_on_border(corners, projection, rounding);
  if (width_of(corners, ends) <= rounding) {
    result.verdict = "turns about a line";
    result.margin = beyond_rounding(-border.distance, rounding);
    result.axis = {plane.place(ends[0]), plane.place(ends[1])};
    return result;
  }
  const bool inside = is_inside(corners, projection);
  result.margin = beyond_rounding(inside ? border.distance : -border.distance, rounding);
  if (result.margin > 0) {
    result.verdict = "stable";
  } else if (border.corner && result.margin < 0) {
    result.verdict = "turns about a point";
  } else {
    result.verdict = "turns about a line";
    result.axis = {plane.place(corners[border.edge]),
                   plane.place(corners[(border.edge + 1) % corners.size()])};
  }
  return result;
}

trace::Stability rest_of(const trace::Pair& pair, const std::string& shape,
                         const Vec3d& center_of_mass, double epsilon) {
  std::vector<Vec3d> points;
  Vec3d normal = Vec3d::Zero();
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) points.push_back(point.position);
    normal += static_cast<double>(manifold.points.size()) * manifold.normal;
  }
  // If opposite normals cancel, use any of them.
  if (normal.norm() > 0.5)
    normal.normalize();
  else if (!pair.manifolds.empty())
    normal = pair.manifolds.front().normal;
  trace::Stability result =
      rest_of(points, normal, center_of_mass, rounding_of(points, center_of_mass, epsilon));
  result.shape = shape;
  return result;
}

}  // namespace contactscope

#include "study/exploration.h"

#include "core/convex_polygon.h"

namespace contactscope {
namespace {

template <class T> std::vector<T> chosen(const std::vector<T>& all, std::span<const int> kept) {
  return mapped(kept, [&](int i) { return at(all, i); });
}

double distance_to_segment(const Vec2d& q, const Vec2d& a, const Vec2d& b) {
  const Vec2d edge = b - a;
  const double length = edge.squaredNorm();
  const double along = length > 0 ? std::clamp(edge.dot(q - a) / length, 0.0, 1.0) : 0.0;
  return (q - a - along * edge).norm();
}

/// Distance of a point outside a convex polygon; inside, minus the distance to the nearest edge. A
/// polygon of one or two corners is a point or segment.
double distance_outside(const Vec2d& q, const std::vector<Vec2d>& polygon) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = polygon.size() > 2;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2d& a = polygon[i];
    const Vec2d& b = polygon[(i + 1) % polygon.size()];
    nearest = std::min(nearest, distance_to_segment(q, a, b));
    inside = inside && cross(b - a, q - a) >= 0;
  }
  return inside ? -nearest : nearest;
}

double radius_of(const std::vector<Vec2d>& points) {
  Vec2d mean = Vec2d::Zero();
  for (const Vec2d& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  double radius = 0;
  for (const Vec2d& point : points) radius = std::max(radius, (point - mean).norm());
  return radius;
}

/// For nested convex sets, the difference of the support functions is largest at a corner of the
/// outer set, where it is the distance to the inner one.
double lost_reach(const std::vector<Vec2d>& all, std::span<const int> kept) {
  const double radius = radius_of(all);
  if (!(radius > 0)) return 0;
  const std::vector<Vec2d> polygon = convex_polygon(chosen(all, kept));
  double most = 0;
  for (const Vec2d& point : all) most = std::max(most, distance_outside(point, polygon));
  return most / radius;
}

/// Collinear kept points, up to rounding, do not determine the slope across their line.
constexpr double kFlat = 1e-12;

/// Separation as a linear function of position, fitted to the kept points, with the smallest slope.
double depth_error(const std::vector<Vec2d>& places, const std::vector<double>& separations,
                   std::span<const int> kept) {
  // Relative to the mean position and depth, in units of the radius, so that the rank shows.
  const double radius = radius_of(places);
  const double scale = radius > 0 ? radius : 1;
  Vec2d mean = Vec2d::Zero();
  double mean_depth = 0;
  for (const int i : kept) {
    mean += at(places, i);
    mean_depth += at(separations, i);
  }
  mean /= static_cast<double>(kept.size());
  mean_depth /= static_cast<double>(kept.size());
  // Along the two principal directions the normal equations are diagonal.
  double xx = 0, xy = 0, yy = 0;
  for (const int i : kept) {
    const Vec2d arm = (at(places, i) - mean) / scale;
    xx += arm.x() * arm.x();
    xy += arm.x() * arm.y();
    yy += arm.y() * arm.y();
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const Vec2d longer(std::cos(angle), std::sin(angle));
  double reach = 0;  // sum of squares along the longer direction
  Vec2d slope = Vec2d::Zero();
  for (const Vec2d& direction : {longer, Vec2d(-longer.y(), longer.x())}) {
    double squares = 0, product = 0;
    for (const int i : kept) {
      const double along = direction.dot(at(places, i) - mean) / scale;
      squares += along * along;
      product += along * (at(separations, i) - mean_depth);
    }
    reach = std::max(reach, squares);
    if (squares > kFlat * kFlat * reach) slope += product / squares * direction;
  }
  double most = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double fitted = mean_depth + slope.dot(places[i] - mean) / scale;
    most = std::max(most, std::abs(fitted - separations[i]));
  }
  return most;
}

}  // namespace

trace::ReducerAnswer measure_reduction(std::span<const ContactPoint<double>> points,
                                       const Vec3d& normal, std::span<const int> kept,
                                       int max_points) {
  trace::ReducerAnswer answer;
  answer.kept.assign(kept.begin(), kept.end());
  if (points.empty() || kept.empty()) {
    answer.area_ratio = points.empty() ? 1 : 0;
    answer.wrench_error = points.empty() ? 0 : 1;
    return answer;
  }
  const std::vector<Vec3d> all = mapped(points, &ContactPoint<double>::position);
  answer.area = convex_area(chosen(all, kept), normal);
  const double best_area = best_convex_area(all, normal, max_points);
  answer.area_ratio = best_area > 0 ? answer.area / best_area : 1;

  const std::vector<double> separations = mapped(points, &ContactPoint<double>::separation);
  const std::vector<Vec2d> places = project(all, normal);
  const double deepest = std::ranges::min(separations);
  // Points within float rounding of the deepest are equally deep, and any of them suffices.
  const double rounding = 8 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
                          (radius_of(places) + std::abs(deepest));
  answer.deepest_kept = std::ranges::min(chosen(separations, kept)) <= deepest + rounding;

  answer.wrench_error = lost_reach(places, kept);
  answer.depth_error = depth_error(places, separations, kept);
  return answer;
}

bool supports(std::span<const ContactPoint<double>> points, const Vec3d& normal,
              std::span<const int> kept, const Vec3d& place) {
  if (kept.empty()) return false;
  std::vector<Vec3d> all = mapped(points, &ContactPoint<double>::position);
  all.push_back(place);
  const std::vector<Vec2d> flat = project(all, normal);
  const double rounding =
      64 * std::numeric_limits<double>::epsilon() * (place.norm() + radius_of(flat));
  return distance_outside(flat.back(), convex_polygon(chosen(flat, kept))) <= rounding;
}

}  // namespace contactscope

#include "study/patch_motion.h"

#include <algorithm>
#include <limits>

namespace contactscope {
namespace {

double nearest(const Vec3d& place, std::span<const trace::Point> others) {
  double least = std::numeric_limits<double>::infinity();
  for (const trace::Point& other : others) least = std::min(least, (place - other.position).norm());
  return least;
}

/// The largest way of a point of `some` to where `others` have its id, or else to the nearest.
double farthest_way(std::span<const trace::Point> some, std::span<const trace::Point> others) {
  double most = 0;
  for (const trace::Point& place : some) {
    const auto same = std::ranges::find(others, place.id, &trace::Point::id);
    most = std::max(most, same != others.end() ? (place.position - same->position).norm()
                                               : nearest(place.position, others));
  }
  return most;
}

Vec3d middle_of(std::span<const trace::Point> places) {
  Vec3d sum = Vec3d::Zero();
  for (const trace::Point& place : places) sum += place.position;
  return sum / static_cast<double>(places.size());
}

}  // namespace

double patch_move(std::span<const trace::Point> before, std::span<const trace::Point> now) {
  if (before.empty() || now.empty()) return 0;
  return std::max({farthest_way(before, now), farthest_way(now, before),
                   (middle_of(now) - middle_of(before)).norm()});
}

double surface_move(const trace::Shape& shape, const Pose<double>& before, const Pose<double>& now,
                    std::span<const trace::Point> contacts) {
  // There and back through the local frame would leave rounding.
  if (before.position == now.position && before.rotation.coeffs() == now.rotation.coeffs())
    return 0;
  double most = 0;
  for (const Vec3d& vertex : shape.vertices)
    most = std::max(most, (now.transform(vertex) - before.transform(vertex)).norm());
  for (const trace::Point& point : contacts) {
    const Vec3d then = before.transform(now.inverse_transform(point.position));
    most = std::max(most, (point.position - then).norm());
  }
  return most;
}

}  // namespace contactscope

#include "draw/scene/pair_points.h"

#include <algorithm>

namespace contactscope::draw {

std::size_t point_count(const trace::Pair& pair) {
  std::size_t count = 0;
  for (const trace::Manifold& manifold : pair.manifolds) count += manifold.points.size();
  return count;
}

std::vector<PairPoint> all_points(const trace::Pair& pair) {
  std::vector<PairPoint> points;
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) points.push_back({&manifold, &point});
  }
  return points;
}

std::vector<PairPoint> kept_points(const trace::Pair& pair) {
  if (pair.manifolds.size() != 1 || !pair.reduction) return all_points(pair);
  const trace::Manifold& manifold = pair.manifolds.front();
  std::vector<PairPoint> points;
  if (manifold.points.empty()) return points;
  const std::vector<int>& kept = pair.reduction->kept;
  const std::vector<trace::Point>& all = pair.reduction->points;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::ranges::find(kept, static_cast<int>(i)) != kept.end())
      points.push_back({&manifold, &all[i]});
  }
  return points;
}

bool is_kept(const trace::Pair& pair, const trace::DroppedPoint& dropped) {
  const Vec3d& normal = pair.clip->reference.normal;
  const trace::Polygon& face = pair.clip->incident.polygon;
  double size = 0;
  for (const Vec3d& p : face) size = std::max(size, (p - face.front()).norm());
  return std::ranges::any_of(all_points(pair), [&](const PairPoint& kept) {
    const Vec3d way = dropped.position - kept.point->position;
    return (way - way.dot(normal) * normal).norm() < 1e-5 * size;
  });
}

}  // namespace contactscope::draw

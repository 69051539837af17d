#include "bench/field_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contactscope::test {

FieldJudge::FieldJudge(const Mesh<double>& mesh) {
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3d first = mesh.corner(t, 1) - mesh.corner(t, 0);
    const Vec3d second = mesh.corner(t, 2) - mesh.corner(t, 0);
    all_.push_back({mesh.corner(t, 0), first, second, first.cross(second).normalized()});
  }
}

Vec3d FieldJudge::Triangle::nearest(const Vec3d& point) const {
  const Vec3d from_a = point - corner;
  const double d1 = first.dot(from_a), d2 = second.dot(from_a);
  if (d1 <= 0 && d2 <= 0) return corner;
  const Vec3d from_b = from_a - first;
  const double d3 = first.dot(from_b), d4 = second.dot(from_b);
  if (d3 >= 0 && d4 <= d3) return corner + first;
  const double c = d1 * d4 - d3 * d2;
  if (c <= 0 && d1 >= 0 && d3 <= 0) return corner + d1 / (d1 - d3) * first;
  const Vec3d from_c = from_a - second;
  const double d5 = first.dot(from_c), d6 = second.dot(from_c);
  if (d6 >= 0 && d5 <= d6) return corner + second;
  const double b = d5 * d2 - d1 * d6;
  if (b <= 0 && d2 >= 0 && d6 <= 0) return corner + d2 / (d2 - d6) * second;
  const double a = d3 * d6 - d5 * d4;
  if (a <= 0 && d4 >= d3 && d5 >= d6) {
    const double along = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return corner + first + along * (second - first);
  }
  return corner + (b * first + c * second) / (a + b + c);
}

void FieldJudge::look_at(const Vec3d& middle, double side) {
  std::vector<double> distances;
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : all_) {
    distances.push_back((triangle.nearest(middle) - middle).norm());
    least = std::min(least, distances.back());
  }
  near_.clear();
  const double most = least + 1.001 * std::sqrt(3.0) * side;
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (distances[i] <= most) near_.push_back(all_[i]);
}

double FieldJudge::distance(const Vec3d& point) const {
  double least = std::numeric_limits<double>::infinity(), height = 0;
  for (const Triangle& triangle : near_) {
    const Vec3d offset = point - triangle.nearest(point);
    const double distance = offset.norm();
    const double own = triangle.normal.dot(offset);
    if (distance > least * (1 + 1e-9)) continue;
    if (distance < least * (1 - 1e-9) || std::abs(own) > std::abs(height)) height = own;
    least = std::min(least, distance);
  }
  return std::copysign(least, height);
}

}  // namespace contactscope::test

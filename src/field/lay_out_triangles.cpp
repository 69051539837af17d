#include <algorithm>

#include "core/at.h"
#include "field/lean.h"
#include "field/triangle_sieve.h"

namespace contactscope {

TriangleSieve::TriangleSieve(const NearestTriangles& triangles, double size)
    : triangles_(triangles), size_(size), slack_(kRoughness * size) {
  const Mesh<double>& mesh = triangles.mesh();
  const std::vector<float> leans = largest_leans(mesh);
  flat_.reserve(mesh.triangles.size());
  for (int t = 0; t < mesh.triangle_count(); ++t) flat_.push_back(flat(mesh, t, at(leans, t)));
  first_of_leaf_.assign(mesh.tree.nodes.size(), -1);
  for (int i = 0; i < count_of(mesh.tree.nodes); ++i) {
    const auto& [box, next, count] = at(mesh.tree.nodes, i);
    if (count == 0) continue;
    at(first_of_leaf_, i) = count_of(leaves_);
    const auto own = std::span(mesh.tree.triangles)
                         .subspan(static_cast<std::size_t>(next), static_cast<std::size_t>(count));
    for (std::size_t first = 0; first < own.size(); first += 4)
      lay_out(own.subspan(first), leaves_.emplace_back());
  }
}

TriangleSieve::Flat TriangleSieve::flat(const Mesh<double>& mesh, int triangle, float lean) const {
  int longest = 0;
  double length = 0;
  for (int k = 0; k < 3; ++k) {
    const double own = (mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k)).norm();
    if (own <= length) continue;
    length = own;
    longest = k;
  }
  const Vec3d origin = mesh.corner(triangle, longest);
  const Vec3d third = mesh.corner(triangle, (longest + 2) % 3) - origin;
  const Vec3d& normal = mesh.normal(triangle);
  const Vec3d first_axis = (mesh.corner(triangle, (longest + 1) % 3) - origin) / length;
  const Vec3d second_axis = normal.cross(first_axis);
  const Eigen::Vector2d tip(third.dot(first_axis), third.dot(second_axis));
  const Eigen::Vector2d second = tip - Eigen::Vector2d(length, 0);
  Flat numbers{};
  const auto set = [&](int first, const auto& vector) {
    for (int i = 0; i < vector.size(); ++i) at(numbers, first + i) = static_cast<float>(vector[i]);
  };
  set(kOrigin, origin);
  set(kAxes, first_axis);
  set(kAxes + 3, second_axis);
  set(kAxes + 6, normal);
  numbers[kBase] = static_cast<float>(length);
  set(kSecond, Eigen::Vector2d(second.normalized()));
  numbers[kSecond + 2] = static_cast<float>(second.norm());
  set(kThird, Eigen::Vector2d(tip.normalized()));
  numbers[kThird + 2] = static_cast<float>(tip.norm());
  // The error of a sliver's normal grows with the rounding of its corners.
  const double rounding = 0x1p-48 * size_ / tip.y();
  numbers[kLean] = rounding < 1 ? static_cast<float>(lean + rounding) : kAnyLean;
  const auto sum_of = [](const Vec3d& direction) {
    return static_cast<float>(direction.lpNorm<1>() * (1 + 0x1p-20));
  };
  numbers[kInward] = sum_of(second_axis);
  const Eigen::Vector2d second_direction = second.normalized(), third_direction = tip.normalized();
  numbers[kInward + 1] =
      sum_of(second_direction.x() * second_axis - second_direction.y() * first_axis);
  numbers[kInward + 2] =
      sum_of(third_direction.y() * first_axis - third_direction.x() * second_axis);
  numbers[kNormal] = sum_of(normal);
  return numbers;
}

void TriangleSieve::lay_out(List& list) const {
  const std::span<const int> triangles = list.triangles_;
  list.fours_.resize((triangles.size() + 3) / 4);
  list.squared_.resize(list.fours_.size());
  std::size_t leaning = 0;
  for (std::size_t i = 0; i < list.fours_.size(); ++i) {
    lay_out(triangles.subspan(4 * i), list.fours_[i]);
    leaning += lanes::bits<float>(list.fours_[i][kLean] >= lanes::all(kTrustedLean)) != 0 ? 1 : 0;
  }
  list.leaning_ = 2 * leaning > list.fours_.size();
}

void TriangleSieve::lay_out(std::span<const int> triangles, Four& laid_out) const {
  const auto of = [&](std::size_t lane) {
    return at(flat_, triangles[std::min(lane, triangles.size() - 1)]).data();
  };
  const float *a = of(0), *b = of(1), *c = of(2), *d = of(3);
  for (std::size_t k = 0; k < kNumbers; k += 4) {
    const Floats one = lanes::load(a + k), two = lanes::load(b + k);
    const Floats three = lanes::load(c + k), four = lanes::load(d + k);
    const Floats low = __builtin_shufflevector(one, two, 0, 4, 1, 5);
    const Floats high = __builtin_shufflevector(one, two, 2, 6, 3, 7);
    const Floats other_low = __builtin_shufflevector(three, four, 0, 4, 1, 5);
    const Floats other_high = __builtin_shufflevector(three, four, 2, 6, 3, 7);
    Floats* to = laid_out.data() + k;
    to[0] = __builtin_shufflevector(low, other_low, 0, 1, 4, 5);
    to[1] = __builtin_shufflevector(low, other_low, 2, 3, 6, 7);
    to[2] = __builtin_shufflevector(high, other_high, 0, 1, 4, 5);
    to[3] = __builtin_shufflevector(high, other_high, 2, 3, 6, 7);
  }
}

}  // namespace contactscope

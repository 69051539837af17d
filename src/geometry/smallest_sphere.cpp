#include <array>
#include <cmath>
#include <optional>

#include <Eigen/QR>

#include "core/at.h"
#include "core/static_vector.h"
#include "geometry/bounds.h"
#include "geometry/extended.h"

namespace contactscope {
namespace {

struct Ball {
  Vec3d center = Vec3d::Zero();
  double squared = -1;  // squared radius
};

using Support = StaticVector<Vec3d, 5>;

/// Smallest ball through all of 1 to 4 points, with its centre in their affine span. None if the
/// points are dependent: a subset then gives the same ball.
std::optional<Ball> ball_through(const Support& points) {
  const Vec3d origin = points[0];
  const int count = static_cast<int>(points.size()) - 1;
  if (count == 0) return Ball{origin, 0};
  Eigen::MatrixXd offsets(3, count);
  for (int i = 0; i < count; ++i) offsets.col(i) = points[static_cast<std::size_t>(i) + 1] - origin;
  const Eigen::MatrixXd gram = 2 * offsets.transpose() * offsets;
  const Eigen::VectorXd squares = 0.5 * gram.diagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(gram);
  if (solver.rank() < count) return std::nullopt;
  const Vec3d out = offsets * solver.solve(squares);
  return Ball{origin + out, out.squaredNorm()};
}

/// Squared lengths within this ratio count as equal.
constexpr double kSame = 1 + 1e-13;

bool holds_all(const Ball& ball, const Support& points) {
  for (const Vec3d& point : points)
    if ((point - ball.center).squaredNorm() > kSame * ball.squared) return false;
  return true;
}

/// Smallest ball that contains at most five points, with the last one on its surface. Reduces
/// `support` to the points on its surface.
std::optional<Ball> smallest_of_few(Support& support) {
  std::optional<Ball> smallest;
  Support kept;
  const std::size_t others = support.size() - 1;
  for (unsigned chosen = 0; chosen < 1U << others; ++chosen) {
    Support through;
    for (std::size_t i = 0; i < others; ++i)
      if ((chosen >> i & 1U) != 0) through.push_back(support[i]);
    if (through.size() > 3) continue;
    through.push_back(support[others]);
    const std::optional<Ball> ball = ball_through(through);
    if (!ball || (smallest && !(ball->squared < smallest->squared))) continue;
    if (!holds_all(*ball, support)) continue;
    smallest = ball;
    kept = through;
  }
  if (smallest) support = kept;
  return smallest;
}

/// Each step grows the ball, so no support set repeats. No known input takes nearly as many steps.
constexpr int kMaxPivots = 200;

Ball smallest_ball(const std::vector<Vec3d>& points) {
  Support support;
  support.push_back(points.front());
  Ball ball{points.front(), 0};
  for (int pivot = 0; pivot < kMaxPivots; ++pivot) {
    double farthest = 0;
    const Vec3d* outside = nullptr;
    for (const Vec3d& point : points) {
      const double squared = (point - ball.center).squaredNorm();
      if (squared <= farthest) continue;
      farthest = squared;
      outside = &point;
    }
    if (outside == nullptr || farthest <= kSame * ball.squared) break;
    support.push_back(*outside);
    const std::optional<Ball> next = smallest_of_few(support);
    if (!next || !(next->squared > ball.squared)) break;  // rounding allows no further progress
    ball = *next;
  }
  return ball;
}

}  // namespace

template <class S>
BoundingSphere<S> sphere_around(std::span<const Vec3<S>> points) {
  if (points.empty()) return {};
  // Relative to the first point and scaled to size 1, so neither distance nor size costs digits.
  const Vec3d origin = points.front().template cast<double>();
  std::vector<Vec3d> local;
  double size = 0;
  for (const Vec3<S>& point : points) {
    local.push_back(point.template cast<double>() - origin);
    size = std::max(size, local.back().template lpNorm<Eigen::Infinity>());
  }
  if (!(size > 0)) return {points.front(), 0};
  for (Vec3d& point : local) point /= size;
  const Vec3d center = origin + size * smallest_ball(local).center;
  BoundingSphere<S> sphere{center.cast<S>(), 0};
  // This radius contains all points, whatever error the search has left.
  long double squared = 0;
  for (const Vec3<S>& point : points) {
    const Vec3<long double> offset =
        point.template cast<long double>() - sphere.center.template cast<long double>();
    squared = std::max(squared, offset.squaredNorm());
  }
  sphere.radius = rounded_up<S>(std::sqrt(squared));
  return sphere;
}

template decltype(sphere_around<float>) sphere_around<float>;
template decltype(sphere_around<double>) sphere_around<double>;

}  // namespace contactscope

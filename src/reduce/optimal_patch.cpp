#include "reduce/optimal_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contactscope {
namespace {

template <class S>
using Lanes = Eigen::Array<S, Patch<S>::kLanes, 1>;

template <class S>
Lanes<S> load(const S* from) {
  return Eigen::Map<const Lanes<S>>(from);
}

/// Whether points that are in convex order are clockwise seen against the normal: as any three.
template <class S>
bool is_clockwise(std::span<const ContactPoint<S>> points, const Vec3<S>& normal) {
  const std::size_t third = points.size() / 3;
  const Vec3<S> a = points[third].position - points[0].position;
  const Vec3<S> b = points[2 * third].position - points[0].position;
  return a.cross(b).dot(normal) < S(0);
}

}  // namespace

/// The basis of the plane after Duff et al. 2017, "Building an Orthonormal Basis, Revisited":
/// neither a square root nor a case.
template <class S>
Patch<S>::Patch(std::span<const ContactPoint<S>> points, const Vec3<S>& normal)
    : origin_(points[0].position), count_(static_cast<int>(points.size())) {
  const S sign = std::copysign(S(1), normal.z());
  const S a = S(-1) / (sign + normal.z());
  const S b = normal.x() * normal.y() * a;
  u_ = {S(1) + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x()};
  is_mirrored_ = is_clockwise(points, normal);
  const S up = is_mirrored_ ? S(-1) : S(1);
  v_ = {up * b, up * (sign + normal.y() * normal.y() * a), -up * normal.y()};
  for (int i = 0; i < count_; ++i) {
    const PlanePoint<S> place = project(points[static_cast<std::size_t>(i)].position);
    x_[i] = place.x;
    y_[i] = place.y;
    point_[i] = i;
  }
  wrap();
  if (!measure()) {
    make_convex();
    wrap();
    measure();
  }
}

template <class S>
PlanePoint<S> Patch<S>::project(const Vec3<S>& position) const {
  // Relative to the first point, so that a place far from the origin costs no digits.
  const S dx = position.x() - origin_.x();
  const S dy = position.y() - origin_.y();
  const S dz = position.z() - origin_.z();
  return {u_.x() * dx + u_.y() * dy + u_.z() * dz, v_.x() * dx + v_.y() * dy + v_.z() * dz};
}

template <class S>
void Patch<S>::wrap() {
  const int end = 2 * count_ + kLanes;
  for (int i = count_; i < end; ++i) x_[i] = x_[i - count_];
  for (int i = count_; i < end; ++i) y_[i] = y_[i - count_];
}

/// Andrew's monotone chain (1979), counter-clockwise, without points on edges. Of coincident points
/// the earliest stays.
template <class S>
void Patch<S>::make_convex() {
  const int all = count_;
  int sorted[kMaxManifoldPoints];
  for (int i = 0; i < all; ++i) sorted[i] = i;
  std::sort(sorted, sorted + all, [this](int i, int j) {
    if (x_[i] != x_[j]) return x_[i] < x_[j];
    return y_[i] != y_[j] ? y_[i] < y_[j] : i < j;
  });
  const auto same = [this](int i, int j) { return x_[i] == x_[j] && y_[i] == y_[j]; };
  const auto different = static_cast<int>(std::unique(sorted, sorted + all, same) - sorted);

  int chain[kMaxManifoldPoints + 1];
  int size = 0;
  const auto extend = [&](int point, int fixed) {
    const PlanePoint<S> c = corner(point);
    for (; size > fixed + 1; --size) {
      const PlanePoint<S> a = corner(chain[size - 2]);
      const PlanePoint<S> b = corner(chain[size - 1]);
      if (cross<S>({b.x - a.x, b.y - a.y}, {c.x - b.x, c.y - b.y}) > S(0)) break;
    }
    chain[size++] = point;
  };
  for (int i = 0; i < different; ++i) extend(sorted[i], 0);
  const int lower = size - 1;
  for (int i = different - 2; i >= 0; --i) extend(sorted[i], lower);
  if (different > 1) --size;  // the first point again

  S x[kMaxManifoldPoints];
  S y[kMaxManifoldPoints];
  for (int i = 0; i < size; ++i) {
    x[i] = x_[chain[i]];
    y[i] = y_[chain[i]];
  }
  count_ = size;
  std::copy_n(x, size, x_);
  std::copy_n(y, size, y_);
  std::copy_n(chain, size, point_);
}

/// Corners are in convex order when all turns are to the left and they go round once. For the
/// latter, seen from the first corner, each is to the left of the one before and none is to the
/// right of the second: all of them together make less than half a turn.
template <class S>
bool Patch<S>::measure() {
  Lanes<S> least_turn = Lanes<S>::Constant(std::numeric_limits<S>::infinity());
  Lanes<S> least_side = least_turn;
  Lanes<S> far = Lanes<S>::Zero();
  // Doubled areas of the triangles of the edges and the first point, which is the first corner, too,
  // before a hull was made.
  S fan[kMaxManifoldPoints + kLanes];
  for (int i = 0; i < count_; i += kLanes) {
    const Lanes<S> x = load(x_ + i);
    const Lanes<S> y = load(y_ + i);
    const Lanes<S> next_x = load(x_ + i + 1);
    const Lanes<S> next_y = load(y_ + i + 1);
    const Lanes<S> turn =
        (next_x - x) * (load(y_ + i + 2) - next_y) - (next_y - y) * (load(x_ + i + 2) - next_x);
    least_turn = least_turn.min(turn);
    least_side = least_side.min(x_[1] * y - y_[1] * x);
    far = far.max(x.abs()).max(y.abs());
    Eigen::Map<Lanes<S>> stored(fan + i);
    stored = x * next_y - y * next_x;
  }
  doubled_area_ = S(0);
  S least_fan = std::numeric_limits<S>::infinity();
  for (int i = 0; i < count_; ++i) doubled_area_ += fan[i];
  for (int i = 1; i < count_ - 1; ++i) least_fan = std::min(least_fan, fan[i]);

  // A coordinate carries an error of half an ulp of its own size, so a difference of two of them
  // does too however small it is itself, and an area that error times the length of the patch.
  const S length = S(2) * far.maxCoeff();
  const S coordinate =
      std::max(std::max(std::abs(origin_.x()), std::abs(origin_.y())), std::abs(origin_.z()));
  rounding_ = S(8) * std::numeric_limits<S>::epsilon() * (coordinate + length);
  is_flat_ = !(doubled_area_ > rounding_ * length);
  return least_turn.minCoeff() > S(0) && least_side.minCoeff() >= S(0) && least_fan > S(0);
}

template class Patch<float>;
template class Patch<double>;

}  // namespace contactscope

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

enum class Order { CounterClockwise, Clockwise, None };

/// Whether the corners go round a strictly convex polygon once. All turns to one side are not
/// enough, a star has them too; but it goes round twice, and meets two local maxima of x.
template <class S>
Order order_of(const S* x, const S* y, int count) {
  Lanes<S> least = Lanes<S>::Constant(std::numeric_limits<S>::infinity());
  Lanes<S> most = -least;
  for (int i = 0; i < count; i += Patch<S>::kLanes) {
    const Lanes<S> middle_x = load(x + i + 1);
    const Lanes<S> middle_y = load(y + i + 1);
    const Lanes<S> turn = (middle_x - load(x + i)) * (load(y + i + 2) - middle_y) -
                          (middle_y - load(y + i)) * (load(x + i + 2) - middle_x);
    least = least.min(turn);
    most = most.max(turn);
  }
  const bool left = least.minCoeff() > S(0);
  if (!left && !(most.maxCoeff() < S(0))) return Order::None;
  int rounds = 0;
  for (int i = 0; i < count; ++i) {
    rounds += static_cast<int>(x[i + 1] > x[i]) & static_cast<int>(x[i + 1] >= x[i + 2]);
  }
  if (rounds != 1) return Order::None;
  return left ? Order::CounterClockwise : Order::Clockwise;
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
  v_ = {b, sign + normal.y() * normal.y() * a, -normal.y()};
  for (int i = 0; i < count_; ++i) {
    const PlanePoint<S> place = project(points[static_cast<std::size_t>(i)].position);
    x_[i] = place.x;
    y_[i] = place.y;
    point_[i] = i;
  }
  wrap();
  const Order order = count_ < 3 ? Order::None : order_of(x_, y_, count_);
  if (order == Order::None) {
    make_convex();
    wrap();
  } else if (order == Order::Clockwise) {
    is_mirrored_ = true;
    v_ = -v_;
    for (int i = 0; i < 2 * count_ + kLanes; ++i) y_[i] = -y_[i];
  }
  measure();
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

template <class S>
void Patch<S>::measure() {
  swept_[0] = S(0);
  for (int i = 0; i < count_; ++i) swept_[i + 1] = swept_[i] + cross(corner(i), corner(i + 1));
  const S round = swept_[count_];
  for (int i = 1; i < count_ + kLanes; ++i) swept_[count_ + i] = round + swept_[i];

  Lanes<S> far_x = Lanes<S>::Zero();
  Lanes<S> far_y = Lanes<S>::Zero();
  for (int i = 0; i < count_; i += kLanes) {
    far_x = far_x.max(load(x_ + i).abs());
    far_y = far_y.max(load(y_ + i).abs());
  }
  // A coordinate carries an error of half an ulp of its own size, so a difference of two of them
  // does too however small it is itself, and an area that error times the length of the patch.
  const S length = S(2) * far_x.max(far_y).maxCoeff();
  rounding_ = S(8) * std::numeric_limits<S>::epsilon() * (origin_.cwiseAbs().maxCoeff() + length);
  is_flat_ = count_ < 3 || round <= rounding_ * length;
}

template class Patch<float>;
template class Patch<double>;

}  // namespace contactscope

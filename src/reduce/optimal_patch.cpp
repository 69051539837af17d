#include "reduce/optimal_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contactscope {
namespace {

using lanes::each;
using lanes::load;
using lanes::Pack;
using lanes::store;

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
  const Vec3<S> origin = origin_;
  for (int i = 0; i < count_; i += kLanes) {
    const Vec3<S>* at[kLanes];
    for (int lane = 0; lane < kLanes; ++lane) {
      const int index = i + lane < count_ ? i + lane : i;
      at[lane] = &points[static_cast<std::size_t>(index)].position;
      point_[i + lane] = i + lane;
    }
    const Pack<S> dx = each<S>([&](int lane) { return at[lane]->x(); }) - origin.x();
    const Pack<S> dy = each<S>([&](int lane) { return at[lane]->y(); }) - origin.y();
    const Pack<S> dz = each<S>([&](int lane) { return at[lane]->z(); }) - origin.z();
    store<S>(u_.x() * dx + u_.y() * dy + u_.z() * dz, x_ + i);
    store<S>(v_.x() * dx + v_.y() * dy + v_.z() * dz, y_ + i);
  }
  if (!measure()) {
    make_convex();
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
void Patch<S>::repeat(S* values) const {
  if (count_ < kLanes) {
    for (int i = count_; i < 2 * count_ + kLanes; ++i) values[i] = values[i - count_];
    return;
  }
  // Nothing that was just written is read: the processor would have to wait for it.
  for (int i = 0; i < count_; i += kLanes) {
    const int from = std::min(i, count_ - kLanes);
    store<S>(load(values + from), values + count_ + from);
  }
  store<S>(load(values), values + 2 * count_);
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

/// Corners are in convex order when all turns are to the left and they go round once: then exactly
/// one corner is higher than the one before and no lower than the next.
template <class S>
bool Patch<S>::measure() {
  repeat(x_);
  repeat(y_);
  const Pack<S> zero = {};
  Pack<S> least_turn = zero + std::numeric_limits<S>::infinity();
  Pack<S> far = zero;
  Pack<S> area = zero;
  lanes::Flags<S> tops = {};
  lanes::Flags<S> left = {};  // corners from here to the last, for an end amid a pack
  for (int lane = 0; lane < kLanes; ++lane) left[lane] = count_ - lane;
  for (int i = 0; i < count_; i += kLanes) {
    const Pack<S> x = load(x_ + i);
    const Pack<S> y = load(y_ + i);
    const Pack<S> next_x = load(x_ + i + 1);
    const Pack<S> next_y = load(y_ + i + 1);
    const Pack<S> dx = next_x - x;
    const Pack<S> dy = next_y - y;
    const Pack<S> next_dx = load(x_ + i + 2) - next_x;
    const Pack<S> next_dy = load(y_ + i + 2) - next_y;
    store<S>(dx, edge_x_ + i);
    store<S>(dy, edge_y_ + i);
    least_turn = lanes::smaller(least_turn, dx * next_dy - dy * next_dx);
    far = lanes::larger(far, lanes::larger(lanes::larger(x, -x), lanes::larger(y, -y)));
    const lanes::Flags<S> is_corner = left > 0;
    tops -= (dy > zero) & (next_dy <= zero) & is_corner;
    area += is_corner ? x * next_y - y * next_x : zero;
    left -= kLanes;
  }
  repeat(edge_x_);
  repeat(edge_y_);
  doubled_area_ = S(0);
  int rounds = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    doubled_area_ += area[lane];
    rounds += static_cast<int>(tops[lane]);
  }

  // A coordinate carries an error of half an ulp of its own size, so a difference of two of them
  // does too however small it is itself, and an area that error times the length of the patch.
  const S length = S(2) * lanes::largest<S>(far);
  const S coordinate =
      std::max(std::max(std::abs(origin_.x()), std::abs(origin_.y())), std::abs(origin_.z()));
  rounding_ = S(8) * std::numeric_limits<S>::epsilon() * (coordinate + length);
  is_flat_ = !(doubled_area_ > rounding_ * length);
  return lanes::smallest<S>(least_turn) > S(0) && rounds == 1;
}

template class Patch<float>;
template class Patch<double>;

}  // namespace contactscope

#include "reduce/optimal_ring.h"

namespace contactscope {
namespace {

using lanes::store;
using widest::all;
using widest::Flags;
using widest::load;
using widest::Pack;

constexpr std::array<int, kMaxManifoldPoints> kNumbers = [] {
  std::array<int, kMaxManifoldPoints> numbers = {};
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i);
  return numbers;
}();

template <class S> struct Positions {
  Pack<S> x, y, z;
  Pack<S> separation = {};
};

/// Reads a pack of points; each separation follows its position in memory and is read with it.
template <class S> Positions<S> read(const ContactPoint<S>* const (&points)[Patch<S>::kLanes]) {
  if constexpr (Patch<S>::kLanes == 2) {
    const Pack<S> first = lanes::load(*points[0], 0), second = lanes::load(*points[1], 0);
    return {__builtin_shufflevector(first, second, 0, 2),
            __builtin_shufflevector(first, second, 1, 3),
            Pack<S>{points[0]->position.z(), points[1]->position.z()},
            Pack<S>{points[0]->separation, points[1]->separation}};
  } else if constexpr (Patch<S>::kLanes == 4) {
    Pack<S> four[4];
    for (int i = 0; i < 4; ++i) std::memcpy(&four[i], points[i], sizeof four[i]);
    const Pack<S> xy01 = __builtin_shufflevector(four[0], four[1], 0, 4, 1, 5);
    const Pack<S> xy23 = __builtin_shufflevector(four[2], four[3], 0, 4, 1, 5);
    const Pack<S> z01 = __builtin_shufflevector(four[0], four[1], 2, 6, 3, 7);
    const Pack<S> z23 = __builtin_shufflevector(four[2], four[3], 2, 6, 3, 7);
    return {__builtin_shufflevector(xy01, xy23, 0, 1, 4, 5),
            __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7),
            __builtin_shufflevector(z01, z23, 0, 1, 4, 5),
            __builtin_shufflevector(z01, z23, 2, 3, 6, 7)};
  } else {
    // The same on both halves of a register: points i and i + 4 share one.
    Pack<S> two[4];
    for (int i = 0; i < 4; ++i)
      two[i] = __builtin_shufflevector(lanes::load(*points[i], 0), lanes::load(*points[i + 4], 0),
                                       0, 1, 2, 3, 4, 5, 6, 7);
    const Pack<S> xy01 = __builtin_shufflevector(two[0], two[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const Pack<S> xy23 = __builtin_shufflevector(two[2], two[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const Pack<S> z01 = __builtin_shufflevector(two[0], two[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const Pack<S> z23 = __builtin_shufflevector(two[2], two[3], 2, 10, 3, 11, 6, 14, 7, 15);
    return {__builtin_shufflevector(xy01, xy23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(xy01, xy23, 2, 3, 10, 11, 6, 7, 14, 15),
            __builtin_shufflevector(z01, z23, 0, 1, 8, 9, 4, 5, 12, 13),
            __builtin_shufflevector(z01, z23, 2, 3, 10, 11, 6, 7, 14, 15)};
  }
}

}  // namespace

/// The basis after Duff et al. 2017, "Building an Orthonormal Basis, Revisited": no branches.
template <class S>
Patch<S>::Patch(const Candidates<S>& points) : origin_(points[0]), count(points.count()) {
  const Vec3<S>& normal = points.normal;
  const S sign = std::copysign(S(1), normal.z());
  const S a = S(-1) / (sign + normal.z());
  const S b = normal.x() * normal.y() * a;
  u_ = {S(1) + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x()};
  v_ = {b, sign + normal.y() * normal.y() * a, -normal.y()};
  // Computed after the basis so that the two do not wait for each other.
  const int third = count / 3;
  // Negative if points in convex order are clockwise seen against the normal.
  up_ = std::copysign(S(1), points.doubled_area(0, third, 2 * third));
  project_all(points.points);
  if (!measure()) {
    make_convex();
    measure();
  }
}

template <class S> void Patch<S>::project_all(ContactPoints<S> points) {
  // Local copies, so that the compiler need not reload the members after each store.
  const Positions<S> from = {all(origin_.x()), all(origin_.y()), all(origin_.z())};
  const Positions<S> u = {all(u_.x()), all(u_.y()), all(u_.z())};
  const Positions<S> v = {all(v_.x()), all(v_.y()), all(v_.z())};
  const Pack<S> up = all(up_);
  const int corners = count;
  const auto lay = [&](const ContactPoint<S>* const(&at)[kLanes], int i) {
    const Positions<S> position = read<S>(at);
    const Pack<S> dx = position.x - from.x;
    const Pack<S> dy = position.y - from.y;
    const Pack<S> dz = position.z - from.z;
    const Pack<S> x = u.x * dx + u.y * dy + u.z * dz;
    const Pack<S> y = up * (v.x * dx + v.y * dy + v.z * dz);
    store<S>(position.separation, separation + i);
    store<S>(x, xs + i);
    store<S>(y, ys + i);
    store<S>(x, xs + corners + i);
    store<S>(y, ys + corners + i);
    std::memcpy(point + i, kNumbers.data() + i, kLanes * sizeof(int));
  };
  const ContactPoint<S>* at[kLanes];
  int i = 0;
  for (; i + kLanes <= corners; i += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) at[lane] = points.data() + i + lane;
    lay(at, i);
  }
  if (i == corners) return;
  // The lanes after the last point repeat the first ones.
  for (int lane = 0; lane < kLanes; ++lane)
    at[lane] = points.data() + std::min(i + lane - (i + lane < corners ? 0 : corners), corners - 1);
  lay(at, i);
  if (2 * corners < kLanes) repeat();
}

template <class S> Vec2<S> Patch<S>::project(const Vec3<S>& position) const {
  // Relative to the first point, so that positions far from the origin lose no digits.
  const S dx = position.x() - origin_.x();
  const S dy = position.y() - origin_.y();
  const S dz = position.z() - origin_.z();
  return {u_.x() * dx + u_.y() * dy + u_.z() * dz, up_ * (v_.x() * dx + v_.y() * dy + v_.z() * dz)};
}

template <class S> void Patch<S>::repeat() {
  for (S* const values : {xs, ys})
    for (int i = count; i < 2 * count + 2 * kLanes; ++i) values[i] = values[i - count];
}

/// Keeps the earliest of coincident points.
template <class S> void Patch<S>::make_convex() {
  StaticVector<int, kMaxManifoldPoints + 1> sorted;
  for (int i = 0; i < count; ++i) sorted.push_back(i);
  std::ranges::sort(sorted, {}, [this](int i) { return std::tuple(xs[i], ys[i], i); });
  const auto same = [this](int i, int j) { return xs[i] == xs[j] && ys[i] == ys[j]; };
  const int* const different = std::unique(sorted.begin(), sorted.end(), same);
  sorted.truncate(static_cast<std::size_t>(different - sorted.begin()));
  const auto hull = convex_chain(sorted, [this](int i, int j, int k) {
    return cross(corner(j) - corner(i), corner(k) - corner(j)) > S(0);
  });

  for (S* const values : {xs, ys, separation}) {
    S kept[kMaxManifoldPoints];
    std::ranges::transform(hull, kept, [values](int i) { return values[i]; });
    std::copy_n(kept, hull.size(), values);
  }
  std::ranges::copy(hull, point);
  count = count_of(hull);
  repeat();
}

/// Corners are in convex order if all turns are to the left and they go round once. Then exactly
/// one corner is higher than the one before and no lower than the next.
template <class S> bool Patch<S>::measure() {
  const Pack<S> zero = {};
  Pack<S> least_turn = zero + std::numeric_limits<S>::infinity();
  Pack<S> high = zero;
  Pack<S> low = zero;
  Pack<S> area = zero;
  Flags<S> tops = {};
  Flags<S> left = {};  // remaining corners, for an end within a pack
  for (int lane = 0; lane < kLanes; ++lane) left[lane] = count - lane;
  Pack<S> x = load(xs);
  Pack<S> y = load(ys);
  for (int i = 0; i < count; i += kLanes) {
    const Pack<S> after_x = load(xs + i + kLanes);
    const Pack<S> after_y = load(ys + i + kLanes);
    const Pack<S> next_x = lanes::straddle<S, 1>(x, after_x);
    const Pack<S> next_y = lanes::straddle<S, 1>(y, after_y);
    const Pack<S> dx = next_x - x;
    const Pack<S> dy = next_y - y;
    const Pack<S> next_dx = lanes::straddle<S, 2>(x, after_x) - next_x;
    const Pack<S> next_dy = lanes::straddle<S, 2>(y, after_y) - next_y;
    least_turn = lanes::smaller(least_turn, dx * next_dy - dy * next_dx);
    high = lanes::larger(high, lanes::larger(x, y));
    low = lanes::smaller(low, lanes::smaller(x, y));
    const Flags<S> is_corner = left > 0;
    tops -= (dy > zero) & (next_dy <= zero) & is_corner;
    area += is_corner ? x * next_y - y * next_x : zero;
    left -= kLanes;
    x = after_x;
    y = after_y;
  }
  doubled_area = S(0);
  int rounds = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    doubled_area += area[lane];
    rounds += static_cast<int>(tops[lane]);
  }

  // A coordinate has an error of half an ulp of its own size. So has a difference of two, however
  // small; an area has that error times the length of the patch.
  const S length = S(2) * lanes::largest<S>(lanes::larger(high, -low))[0];
  const S coordinate =
      std::max(std::max(std::abs(origin_.x()), std::abs(origin_.y())), std::abs(origin_.z()));
  rounding_ = S(8) * std::numeric_limits<S>::epsilon() * (coordinate + length);
  tie = rounding_ * length;
  is_flat = !(doubled_area > tie);
  return lanes::smallest<S>(least_turn)[0] > S(0) && rounds == 1;
}

template class Patch<float>;
template class Patch<double>;

}  // namespace contactscope

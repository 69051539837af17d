#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "geometry/obb.h"

/// Separating axis test of oriented boxes by brute force, with their numbers taken as exact:
/// projects the corners in numbers of 113 bits, which hold the products of two doubles.
namespace contactscope::test {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;
#else
using Quad = long double;  // has 113 bits on arm64
static_assert(std::numeric_limits<Quad>::digits == 113);
#endif
using QuadVector = std::array<Quad, 3>;

inline Quad dot(const QuadVector& a, const QuadVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline QuadVector cross(const QuadVector& a, const QuadVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct QuadBox {
  std::array<QuadVector, 3> axes;
  std::array<QuadVector, 8> corners;

  template <class S> QuadBox(const Obb<S>& box, const Vec3<S>& origin) {
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) axes[std::size_t(k)][std::size_t(i)] = Quad(box.axes(i, k));
    for (std::size_t corner = 0; corner < 8; ++corner) {
      for (int i = 0; i < 3; ++i) {
        Quad x = Quad(box.center[i]) - Quad(origin[i]);
        for (std::size_t k = 0; k < 3; ++k) {
          const Quad reach = Quad(box.half_extents[int(k)]) * axes[k][std::size_t(i)];
          x += (corner >> k & 1) != 0 ? reach : -reach;
        }
        corners[corner][std::size_t(i)] = x;
      }
    }
  }
};

/// Separation along an axis of any length, in metres; -infinity along the zero vector.
inline double gap_along(const QuadVector& axis, const QuadBox& a, const QuadBox& b) {
  const Quad squared = dot(axis, axis);
  if (squared == 0) return -std::numeric_limits<double>::infinity();
  Quad low_a = dot(axis, a.corners[0]), high_a = low_a, low_b = dot(axis, b.corners[0]),
       high_b = low_b;
  for (std::size_t i = 1; i < 8; ++i) {
    const Quad of_a = dot(axis, a.corners[i]), of_b = dot(axis, b.corners[i]);
    low_a = of_a < low_a ? of_a : low_a;
    high_a = of_a > high_a ? of_a : high_a;
    low_b = of_b < low_b ? of_b : low_b;
    high_b = of_b > high_b ? of_b : high_b;
  }
  const Quad one = low_b - high_a, other = low_a - high_b;
  return double((one > other ? one : other) / Quad(std::sqrt((long double)(squared))));
}

/// The largest separation over all face normals (cross products of the columns) and all cross
/// products of edges. Positive exactly if the boxes are separated, and then at most their distance.
template <class S> double exact_gap(const Obb<S>& a, const Obb<S>& b) {
  const QuadBox of_a(a, a.center), of_b(b, a.center);
  double largest = -std::numeric_limits<double>::infinity();
  const auto add = [&](const QuadVector& axis) {
    largest = std::max(largest, gap_along(axis, of_a, of_b));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    add(cross(of_a.axes[i], of_a.axes[(i + 1) % 3]));
    add(cross(of_b.axes[i], of_b.axes[(i + 1) % 3]));
    for (const QuadVector& axis : of_b.axes) add(cross(of_a.axes[i], axis));
  }
  return largest;
}

/// The length that rounding is relative to: all half extents plus the offset of the centres.
template <class S> double size_of_pair(const Obb<S>& a, const Obb<S>& b) {
  const Vec3d offset = b.center.template cast<double>() - a.center.template cast<double>();
  return offset.lpNorm<1>() + double(a.half_extents.sum()) + double(b.half_extents.sum());
}

}  // namespace contactscope::test

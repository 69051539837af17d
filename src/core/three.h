#pragma once

#include "core/pack.h"

namespace contactscope {

/// x + y + z, in the order in which Eigen's dot(), norm() etc. of three-vectors of S add. A loop
/// over lanes then gives the same bits. Eigen sums a register of two numbers first; without a full
/// register it halves the sum. `P` is S or a pack of S.
template <class S, class P>
[[gnu::always_inline]] inline P dot_sum(const P& x, const P& y, const P& z) {
  using Packet = typename Eigen::internal::find_best_packet<S, 3>::type;
  if constexpr (Eigen::internal::unpacket_traits<Packet>::size == 2) return (x + y) + z;
  return x + (y + z);
}

}  // namespace contactscope

/// Three-vectors in one register, for kernels that work on a whole vector at a time.
namespace contactscope::lanes {

/// Three numbers side by side. The fourth lane is undefined and may be NaN.
template <class S> using Three = typename Vector<S, 4>::Type;

/// Entries 1, 2, 0 and 2, 0, 1 of a vector: the factors of a cross product.
template <class T> [[gnu::always_inline]] inline T next(const T& v) {
  return __builtin_shufflevector(v, v, 1, 2, 0, 3);
}
template <class T> [[gnu::always_inline]] inline T after_next(const T& v) {
  return __builtin_shufflevector(v, v, 2, 0, 1, 3);
}
template <int kLane, class T> [[gnu::always_inline]] inline T spread(const T& v) {
  return __builtin_shufflevector(v, v, kLane, kLane, kLane, kLane);
}

template <class S> [[gnu::always_inline]] inline Vec3<S> vector(const Three<S>& v) {
  return {v[0], v[1], v[2]};
}

/// The columns of a 3x3 matrix.
template <class S> struct Columns {
  Three<S> of[3];

  [[gnu::always_inline]] Columns transposed() const {
    const auto& [x, y, z] = of;
    const Three<S> low = __builtin_shufflevector(x, y, 0, 4, 1, 5);
    const Three<S> high = __builtin_shufflevector(x, y, 2, 6, 3, 7);
    return {{__builtin_shufflevector(low, z, 0, 1, 4, 5),
             __builtin_shufflevector(low, z, 2, 3, 5, 5),
             __builtin_shufflevector(high, z, 0, 1, 6, 6)}};
  }
  /// Matrix times `v`: the sum of the columns, each times an entry of `v`.
  [[gnu::always_inline]] Three<S> times(const Three<S>& v) const {
    return of[0] * spread<0>(v) + of[1] * spread<1>(v) + of[2] * spread<2>(v);
  }
};

/// Rotation matrix, bit for bit Quaternion::toRotationMatrix(): the same products and sums, three
/// at a time. The fourth lanes are finite when the quaternion is.
///
///     1 - (yy + zz)    xy - wz         xz + wy         each product is twice the first
///     xy + wz          1 - (xx + zz)   yz - wx         number times the second
///     xz - wy          yz + wx         1 - (xx + yy)
template <class S>
[[gnu::always_inline]] inline Columns<S> rotation_columns(const Quat<S>& rotation) {
  const Three<S> q = load_pack<Three<S>>(rotation.coeffs().data());  // x, y, z, w
  const Three<S> twice = q + q;
  const Three<S> squares = twice * q;  // xx, yy, zz
  const Three<S> mixed = __builtin_shufflevector(twice, twice, 1, 2, 2, 2) *
                         __builtin_shufflevector(q, q, 0, 0, 1, 1);  // xy, xz, yz
  const Three<S> turning = twice * spread<3>(q);                     // wx, wy, wz
  const Three<S> across = __builtin_shufflevector(turning, turning, 2, 1, 0, 0);
  const Three<S> diagonal = S(1) - (__builtin_shufflevector(squares, squares, 1, 0, 0, 0) +
                                    __builtin_shufflevector(squares, squares, 2, 2, 1, 1));
  const Three<S> sums = mixed + across;         // xy + wz, xz + wy, yz + wx
  const Three<S> differences = mixed - across;  // xy - wz, xz - wy, yz - wx
  const Three<S> first = __builtin_shufflevector(sums, differences, 0, 0, 5, 5);
  const Three<S> second = __builtin_shufflevector(differences, diagonal, 0, 0, 5, 5);
  const Three<S> third = __builtin_shufflevector(sums, differences, 1, 1, 6, 6);
  return {{__builtin_shufflevector(diagonal, first, 0, 5, 6, 6),
           __builtin_shufflevector(second, sums, 0, 2, 6, 6),
           __builtin_shufflevector(third, diagonal, 0, 2, 6, 6)}};
}

}  // namespace contactscope::lanes

#pragma once

#include "query/fast/box_pair.h"

/// Three-vectors in one register each, with operations that are bitwise equal to Eigen's.
namespace contactscope::boxes {

/// u x v. The bracket has entry k + 1 in lane k.
template <class S>
[[gnu::always_inline]] inline Three<S> cross(const Three<S>& u, const Three<S>& v) {
  return next(Three<S>(u * next(v) - next(u) * v));
}

/// Sum of the three entries, in the order of Eigen's dot().
template <class S> [[gnu::always_inline]] inline S sum_of(const Three<S>& v) {
  return dot_sum<S>(v[0], v[1], v[2]);
}
template <class S> [[gnu::always_inline]] inline S largest_of(const Three<S>& v) {
  return std::max(std::max(v[0], v[1]), v[2]);
}

/// The largest of nine lanes, and the flags of nine: lane i of pack k has bit 4 k + i.
template <class S>
[[gnu::always_inline]] inline S largest_of(const Three<S>& a, const Three<S>& b,
                                           const Three<S>& c) {
  return largest_of<S>(lanes::larger(lanes::larger(a, b), c));
}
template <class S, class F>
[[gnu::always_inline]] inline std::uint32_t bits_of_nine(const F& a, const F& b, const F& c) {
  return (lane_bits<S>(a) | lane_bits<S>(b) << 4 | lane_bits<S>(c) << 8) & 0x777U;
}

/// Four vectors as x, y and z packs.
template <class S> struct Coordinates {
  [[gnu::always_inline]] Coordinates(const Three<S>& one, const Three<S>& two,
                                     const Three<S>& three, const Three<S>& four) {
    const Three<S> low = __builtin_shufflevector(one, two, 0, 4, 1, 5);
    const Three<S> low_too = __builtin_shufflevector(three, four, 0, 4, 1, 5);
    const Three<S> high = __builtin_shufflevector(one, two, 2, 6, 3, 7);
    const Three<S> high_too = __builtin_shufflevector(three, four, 2, 6, 3, 7);
    x = __builtin_shufflevector(low, low_too, 0, 1, 4, 5);
    y = __builtin_shufflevector(low, low_too, 2, 3, 6, 7);
    z = __builtin_shufflevector(high, high_too, 0, 1, 4, 5);
  }
  /// Sum of each vector's entries.
  [[gnu::always_inline]] Three<S> sums() const { return dot_sum<S>(x, y, z); }
  /// Dot products with four other vectors.
  [[gnu::always_inline]] Three<S> dot(const Coordinates& other) const {
    return dot_sum<S>(Three<S>(x * other.x), Three<S>(y * other.y), Three<S>(z * other.z));
  }

  Three<S> x, y, z;
};

/// A rotation as a quaternion, real part in the last lane.
template <class S> struct Turn {
  /// Rotates a vector as Eigen does with a quaternion.
  [[gnu::always_inline]] Three<S> of(const Three<S>& v) const {
    const Three<S> half = cross<S>(quaternion, v);
    const Three<S> whole = half + half;
    return v + spread<3>(quaternion) * whole + cross<S>(quaternion, whole);
  }

  Three<S> quaternion;
};

/// A rotation matrix whose products equal Eigen's.
template <class S> class TurnMatrix {
 public:
  [[gnu::always_inline]] explicit TurnMatrix(const Quat<S>& rotation) {
    if constexpr (kInPacks) {
      const Three<S> q = four_of<S, 0>(rotation), twice = q + q;
      const Three<S> squares = twice * q;
      const Three<S> mixed = twice * next(q);        // 2 x y, 2 y z, 2 z x
      const Three<S> with_w = twice * spread<3>(q);  // 2 w x, 2 w y, 2 w z
      // Column k contains entry k of each vector, from the diagonal downwards, wrapping around:
      //     d0 a1 b2
      //     b0 d1 a2
      //     a0 b1 d2
      const Three<S> diagonal = S(1) - (next(squares) + after_next(squares));
      const Three<S> below = mixed + after_next(with_w);
      const Three<S> above = after_next(mixed) - next(with_w);
      const Three<S> low = __builtin_shufflevector(diagonal, below, 0, 4, 1, 5);
      const Three<S> high = __builtin_shufflevector(diagonal, below, 2, 6, 3, 7);
      const Three<S> second = __builtin_shufflevector(low, above, 2, 3, 5, 5);
      const Three<S> third = __builtin_shufflevector(high, above, 0, 1, 6, 6);
      columns_.of[0] = __builtin_shufflevector(low, above, 0, 1, 4, 4);
      columns_.of[1] = after_next(second);
      columns_.of[2] = next(third);
    } else {
      matrix_ = rotation.toRotationMatrix();
      for (int k = 0; k < 3; ++k) columns_.of[k] = three(Vec3<S>(matrix_.col(k)));
    }
  }

  /// Product with a vector, in the order of Eigen.
  [[gnu::always_inline]] Three<S> of(const Three<S>& v) const {
    if constexpr (kInPacks) {
      return dot_sum<S>(Three<S>(columns_.of[0] * spread<0>(v)),
                        Three<S>(columns_.of[1] * spread<1>(v)),
                        Three<S>(columns_.of[2] * spread<2>(v)));
    } else {
      return three(Vec3<S>(matrix_ * vector<S>(v)));
    }
  }
  /// Product with a vector, in the order of dot() in lanes.h, which is used to place hulls.
  [[gnu::always_inline]] Three<S> of_placed(const Three<S>& v) const {
    return (columns_.of[0] * spread<0>(v) + columns_.of[1] * spread<1>(v)) +
           columns_.of[2] * spread<2>(v);
  }

 private:
  /// In double, Eigen adds the rows of a product in varying order, so call Eigen itself.
  static constexpr bool kInPacks = std::is_same_v<S, float>;

  Columns<S> columns_;
  Mat3<S> matrix_;
};

}  // namespace contactscope::boxes

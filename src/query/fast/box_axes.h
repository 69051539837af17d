#pragma once

#include "core/three.h"
#include "geometry/obb.h"

/// The fifteen axes of two oriented boxes, three per pack: Gottschalk, Lin and Manocha 1996.
/// Everything in A's frame, where A's axes are the coordinate axes and B's axes are the columns of
/// R = A^T B. The cross product of axis i of A and axis j of B has the entries of column j of R
/// rotated by 90 degrees about axis i. It also projects both boxes by entries of R.
namespace contactscope::boxes {

using lanes::after_next, lanes::Columns, lanes::next, lanes::spread, lanes::Three;

/// Loads four numbers, starting with number `kFirst`, from a type that consists of numbers only.
template <class S, int kFirst, class T>
[[gnu::always_inline]] inline Three<S> four_of(const T& numbers) {
  static_assert(sizeof(T) >= (kFirst + 4) * sizeof(S) && std::is_standard_layout_v<T>);
  Three<S> pack;
  std::memcpy(&pack, reinterpret_cast<const std::byte*>(&numbers) + kFirst * sizeof(S),
              sizeof pack);
  return pack;
}

template <class S> [[gnu::always_inline]] inline Three<S> absolute(const Three<S>& v) {
  using Bits = decltype(v < v);
  constexpr auto kAllButSign = std::numeric_limits<std::remove_cvref_t<decltype(Bits{}[0])>>::max();
  return (Three<S>)((Bits)v & kAllButSign);  // NOLINT: GCC reinterprets the bits
}

/// True if the first three lanes are true; `holds` is a comparison of two Three.
template <class S, class Flags> [[gnu::always_inline]] inline bool all(const Flags& holds) {
  if constexpr (sizeof(S) == 4) {
    return (lanes::bits<S>(holds) & 7U) == 7U;
  } else {
    return (holds[0] & holds[1] & holds[2]) != 0;
  }
}

/// Projections on three axes of any length: distance of the centres, and half extents.
template <class S> struct Projections {
  Three<S> distance, reach_a, reach_b;

  /// Gap between the boxes times the length of the axis; negative in overlap.
  [[gnu::always_inline]] Three<S> gap() const { return distance - (reach_a + reach_b); }
};

template <class S> class BoxAxes {
 public:
  [[gnu::always_inline]] BoxAxes(const Obb<S>& a, const Obb<S>& b) {
    const Columns<S> axes_a{{four_of<S, 3>(a), four_of<S, 6>(a), four_of<S, 9>(a)}};
    const Columns<S> axes_b{{four_of<S, 3>(b), four_of<S, 6>(b), four_of<S, 9>(b)}};
    const Columns<S> to_a = axes_a.transposed();
    const Three<S> offset = four_of<S, 0>(b) - four_of<S, 0>(a);
    half_a_ = half_extents(a);
    half_b_ = half_extents(b);
    offset_ = to_a.times(offset);
    for (int j = 0; j < 3; ++j) {
      rotation_.of[j] = to_a.times(axes_b.of[j]);
      absolute_.of[j] = absolute<S>(rotation_.of[j]);
    }
  }

  [[gnu::always_inline]] Projections<S> faces_of_a() const {
    return {absolute<S>(offset_), half_a_, absolute_.times(half_b_)};
  }
  [[gnu::always_inline]] Projections<S> faces_of_b() const {
    const Columns<S> rows = rotation_.transposed();
    const Columns<S> sizes{
        {absolute<S>(rows.of[0]), absolute<S>(rows.of[1]), absolute<S>(rows.of[2])}};
    return {absolute<S>(rows.times(offset_)), sizes.times(half_a_), half_b_};
  }
  /// Projections on the cross products of the three axes of A with axis j of B.
  template <int kJ> [[gnu::always_inline]] Projections<S> edges() const {
    constexpr int kNext = (kJ + 1) % 3, kAfter = (kJ + 2) % 3;
    const Three<S>& column = rotation_.of[kJ];
    const Three<S>& size = absolute_.of[kJ];
    return {absolute<S>(after_next(offset_) * next(column) - next(offset_) * after_next(column)),
            next(half_a_) * after_next(size) + after_next(half_a_) * next(size),
            spread<kNext>(half_b_) * absolute_.of[kAfter] +
                spread<kAfter>(half_b_) * absolute_.of[kNext]};
  }
  /// Squared lengths of the same cross products: squared sines of the angles.
  template <int kJ> [[gnu::always_inline]] Three<S> squared_lengths() const {
    const Three<S> squares = rotation_.of[kJ] * rotation_.of[kJ];
    return next(squares) + after_next(squares);
  }
  /// Sums of their absolute entries: from the sine to sqrt(2) times the sine.
  template <int kJ> [[gnu::always_inline]] Three<S> rough_lengths() const {
    return next(absolute_.of[kJ]) + after_next(absolute_.of[kJ]);
  }

  /// Sum of all half extents and of the offset between the centres: scale of the rounding.
  [[gnu::always_inline]] S size() const {
    const Three<S> sum = absolute<S>(offset_) + half_a_ + half_b_;
    return sum[0] + sum[1] + sum[2];
  }
  /// True if no half extent is negative or NaN, and no length infinite.
  [[gnu::always_inline]] bool are_boxes() const {
    return all<S>((half_a_ >= S(0)) & (half_b_ >= S(0))) && size() <= std::numeric_limits<S>::max();
  }

 private:
  [[gnu::always_inline]] static Three<S> half_extents(const Obb<S>& box) {
    const Three<S> last = four_of<S, 11>(box);  // at the end of the box: nothing follows it
    return __builtin_shufflevector(last, last, 1, 2, 3, 3);
  }

  Columns<S> rotation_, absolute_;
  Three<S> offset_, half_a_, half_b_;
};

}  // namespace contactscope::boxes

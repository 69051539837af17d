#pragma once

#include "geometry/box_topology.h"
#include "query/fast/box_axes.h"
#include "query/hull_pair.h"

/// Two boxes (Hull::is_box) in registers: the equivalent of HullPair, with bitwise equal numbers. A
/// box is given by its half extents: a vertex is a sum of three columns with signs, and so is its
/// projection on any axis. Rounding is monotone, so the minimum of eight such sums is the sum of
/// the three minimal terms in the same order. No vertex needs to be computed.
namespace contactscope::boxes {

using lanes::vector;

/// One bit per lane, for the four lanes of a comparison of two Three.
template <class S, class Flags>
[[gnu::always_inline]] inline std::uint32_t lane_bits(const Flags& holds) {
  if constexpr (sizeof(S) == 4 || lanes::kWidest<S> == 4) {
    return lanes::bits<S>(holds);
  } else {
    lanes::Flags<S> halves[2];
    std::memcpy(halves, &holds, sizeof halves);
    return lanes::bits<S>(halves[0]) | lanes::bits<S>(halves[1]) << 2;
  }
}

template <class S> [[gnu::always_inline]] inline Three<S> three(const Vec3<S>& v, S fourth = S(0)) {
  return Three<S>{v.x(), v.y(), v.z(), fourth};
}
template <class S> [[gnu::always_inline]] inline Three<S> all_of(S value) {
  return Three<S>{value, value, value, value};
}

/// The signs of each vertex's coordinates.
template <class S>
inline constexpr std::array<std::array<S, 4>, 8> kVertexSigns = [] {
  std::array<std::array<S, 4>, 8> signs{};
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t k = 0; k < 3; ++k) signs[i][k] = (i >> k & 1) != 0 ? S(1) : S(-1);
  return signs;
}();

template <class S> [[gnu::always_inline]] inline Three<S> square_roots(const Three<S>& of) {
  Three<S> roots;
  for (int i = 0; i < 4; ++i) roots[i] = std::sqrt(of[i]);
  return roots;
}

/// A vertex of a box about the origin.
template <class S>
[[gnu::always_inline]] inline Three<S> vertex_of_box(const Three<S>& half, int vertex) {
  return half *
         lanes::load_pack<Three<S>>(kVertexSigns<S>[static_cast<std::size_t>(vertex)].data());
}

template <class S> struct BoxPair {
  [[gnu::always_inline]] BoxPair(const Hull<S>& hull_a, const Hull<S>& hull_b,
                                 const Pose<S>& b_in_a)
      : a(hull_a),
        b(hull_b),
        position(b_in_a.position),
        scale(hull_a.radius + hull_b.radius + b_in_a.position.norm()),
        min_radius(std::min(hull_a.radius, hull_b.radius)),
        // The fourth lane is infinite and therefore wins no comparison.
        half_a(three(hull_a.half_extents, std::numeric_limits<S>::infinity())),
        half_b(three(hull_b.half_extents, std::numeric_limits<S>::infinity())),
        offset(three(position)),
        columns(lanes::rotation_columns(b_in_a.rotation)),
        rows(columns.transposed()) {
    arms.of[0] = columns.of[0] * spread<0>(half_b);
    arms.of[1] = columns.of[1] * spread<1>(half_b);
    arms.of[2] = columns.of[2] * spread<2>(half_b);
  }

  /// Entry of the matrix that rotates B's frame into A's: B's axis j along A's axis i.
  [[gnu::always_inline]] S rotation(int i, int j) const { return columns.of[j][i]; }

  /// Unit vectors along B's axes, equal to the directions of its half-edges in positive direction.
  [[gnu::always_inline]] Columns<S> directions_of_b() const {
    const Three<S> lengths = half_b + half_b;
    const Three<S> x = rows.of[0] * lengths, y = rows.of[1] * lengths, z = rows.of[2] * lengths;
    const Three<S> norms =
        square_roots<S>(dot_sum<S>(Three<S>(x * x), Three<S>(y * y), Three<S>(z * z)));
    return {{columns.of[0] * spread<0>(lengths) / spread<0>(norms),
             columns.of[1] * spread<1>(lengths) / spread<1>(norms),
             columns.of[2] * spread<2>(lengths) / spread<2>(norms)}};
  }

  const Hull<S>& a;
  const Hull<S>& b;
  Vec3<S> position;     // of B in A's frame
  S scale, min_radius;  // as in HullPair, metres
  Three<S> half_a, half_b, offset;
  Columns<S> columns, rows;  // of the rotation: B's axes in A's frame, A's axes in B's
  Columns<S> arms;           // from B's centre to the centres of its faces +x, +y, +z
};

/// The vertices of A in its own frame.
template <class S> class VerticesOfA {
 public:
  [[gnu::always_inline]] explicit VerticesOfA(const BoxPair<S>& pair)
      : half_(three(pair.a.half_extents)) {}
  [[gnu::always_inline]] Three<S> operator[](int vertex) const {
    return vertex_of_box<S>(half_, vertex);
  }

 private:
  Three<S> half_;
};

/// The vertices of B in A's frame, summed as in place(): opposite sums differ only in sign.
template <class S> class VerticesOfB {
 public:
  [[gnu::always_inline]] explicit VerticesOfB(const BoxPair<S>& pair) {
    const auto& [x, y, z] = pair.arms.of;
    const Three<S> sum = x + y, difference = x - y;
    const Three<S> sums[] = {sum + z, difference + z, sum - z, difference - z};
    placed_[7] = sums[0] + pair.offset;
    placed_[5] = sums[1] + pair.offset;
    placed_[3] = sums[2] + pair.offset;
    placed_[1] = sums[3] + pair.offset;
    placed_[0] = pair.offset - sums[0];
    placed_[2] = pair.offset - sums[1];
    placed_[4] = pair.offset - sums[2];
    placed_[6] = pair.offset - sums[3];
  }
  [[gnu::always_inline]] const Three<S>& operator[](int vertex) const { return placed_[vertex]; }

 private:
  Three<S> placed_[8];
};

}  // namespace contactscope::boxes

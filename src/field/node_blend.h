#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/pack.h"
#include "core/vec3.h"

/// The numbers of a lattice's nodes, rounded to 16 bits, and their blend: what a query of a distance field
/// does most of the time.
namespace contactscope {

/// A node, rounded: its distance in steps, which the field chooses so that all fit, and the gradient of
/// the distance in parts of kGradientScale, all even.
struct FieldNode {
  std::int16_t distance;
  std::array<std::int16_t, 3> gradient;
};

/// Two nodes beside each other along x, the nearer one first, as a blend reads them.
struct alignas(16) NodePair {
  NodePair() = default;
  NodePair(const FieldNode& near, const FieldNode& far)
      : distance{near.distance, far.distance},
        gradient{{{near.gradient[0], far.gradient[0]},
                  {near.gradient[1], far.gradient[1]},
                  {near.gradient[2], far.gradient[2]}}} {}

  std::array<std::int16_t, 2> distance;
  /// The last number is odd where the cell of which these two nodes are the first asks its triangles: a
  /// query learns so without a look at other memory.
  std::array<std::array<std::int16_t, 2>, 3> gradient;

  bool asks_triangles() const { return (gradient[2][1] & 1) != 0; }
  void ask_triangles() { gradient[2][1] = static_cast<std::int16_t>(gradient[2][1] | 1); }
};

inline constexpr float kGradientScale = 32766;
inline constexpr double kMostSteps = 32767;

/// Distance, then its gradient, rounded. A distance is off by half a step, and by less than 1/100 of one
/// that float's rounding may add.
inline FieldNode rounded_node(const lanes::Pack<float>& node, float steps_per_cell) {
  const auto rounded = [](float value) { return static_cast<std::int16_t>(std::lrintf(value)); };
  const auto even = [&](float slope) {
    return static_cast<std::int16_t>(2 * rounded(0.5F * kGradientScale * slope));
  };
  return {rounded(std::clamp(node[0] * steps_per_cell, -32767.0F, 32767.0F)),
          {even(node[1]), even(node[2]), even(node[3])}};
}
inline constexpr double kNodeRounding = 0.51;  // steps

/// Weights of the blend have so many bits: a point is taken for one that is 2^-14 of a cell from it.
inline constexpr int kWeightBits = 14;
inline constexpr int kWeightOne = 1 << kWeightBits;

/// How pairs of nodes lie in memory, and what their numbers count: of the coarse ones or of a fine block.
struct NodeLayout {
  NodeLayout() = default;
  /// `row` and `layer`: from a pair to the next along y and along z; along x it is 1. The way between
  /// two nodes is 2^`side` cells. `most`: the largest distance, cells.
  NodeLayout(std::ptrdiff_t row, std::ptrdiff_t layer, int side, float most)
      : next_y(row),
        next_z(layer),
        step(most / static_cast<float>(kMostSteps)),
        slope(static_cast<float>(1 << side) / kGradientScale),
        side_bits(side) {}

  std::ptrdiff_t next_y = 0, next_z = 0;
  float step = 1;   // what a distance counts, cells
  float slope = 1;  // what a gradient counts from node to node, cells
  int side_bits = 0;
};

namespace node_blend {

using Floats = lanes::Pack<float>;
using Integers = lanes::Flags<float>;

#ifdef __SSE2__
/// A point in parts of a cell, kWeightOne of them, and 0. What is too large for an integer is negative.
inline Integers parts_of(const Vec3d& point) {
  const __m128d unit = _mm_set1_pd(kWeightOne);
  const __m128i xy = _mm_cvttpd_epi32(_mm_mul_pd(_mm_loadu_pd(point.data()), unit));
  const __m128i z = _mm_cvttpd_epi32(_mm_mul_pd(_mm_load_sd(point.data() + 2), unit));
  return reinterpret_cast<Integers>(_mm_unpacklo_epi64(xy, z));
}
/// Lane i, a number from 0 to 2^16 - 1.
template <int i>
int small_lane(const Integers& numbers) {
  return _mm_extract_epi16(reinterpret_cast<__m128i>(numbers), 2 * i);
}
/// Numbers of 16 bits, near node and far node in turns.
using Pairs = __m128i;
/// near * low + far * high in each lane; both weights have 16 bits.
inline Floats sums(Pairs pairs, const Integers& low, const Integers& high) {
  const Integers weights = (high << 16) | (low & 0xffff);
  return _mm_cvtepi32_ps(_mm_madd_epi16(pairs, reinterpret_cast<__m128i>(weights)));
}
#else
inline Integers parts_of(const Vec3d& point) {
  const auto part = [&](int axis) {
    const double scaled = kWeightOne * point[axis];
    return std::abs(scaled) < 0x1p31 ? static_cast<int>(scaled) : -1;
  };
  return Integers{part(0), part(1), part(2), 0};
}
template <int i>
int small_lane(const Integers& numbers) {
  return numbers[i];
}
struct Pairs {
  Integers near, far;
};
inline Floats sums(const Pairs& pairs, const Integers& low, const Integers& high) {
  return __builtin_convertvector(low * pairs.near + high * pairs.far, Floats);
}
#endif

/// The eight nodes around a cell, each number by itself: its lanes are the rows along x whose y and z
/// are near near, far near, near far, far far.
struct Around {
  Pairs distance, slope_x, slope_y, slope_z;
};
inline Around around(const NodePair* first, const NodeLayout& layout) {
  const NodePair* far = first + layout.next_z;
#ifdef __SSE2__
  const auto load = [](const NodePair* pair) {
    return _mm_load_si128(reinterpret_cast<const __m128i*>(pair));
  };
  const __m128i a = load(first), b = load(first + layout.next_y);
  const __m128i c = load(far), d = load(far + layout.next_y);
  const __m128i ab = _mm_unpacklo_epi32(a, b), cd = _mm_unpacklo_epi32(c, d);
  const __m128i ab_last = _mm_unpackhi_epi32(a, b), cd_last = _mm_unpackhi_epi32(c, d);
  return {_mm_unpacklo_epi64(ab, cd), _mm_unpackhi_epi64(ab, cd),
          _mm_unpacklo_epi64(ab_last, cd_last), _mm_unpackhi_epi64(ab_last, cd_last)};
#else
  const std::array<const NodePair*, 4> rows = {first, first + layout.next_y, far,
                                               far + layout.next_y};
  const auto gathered = [&](const auto& number) {
    const auto of = [&](std::size_t node) {
      return Integers{number(*rows[0])[node], number(*rows[1])[node], number(*rows[2])[node],
                      number(*rows[3])[node]};
    };
    return Pairs{of(0), of(1)};
  };
  return {gathered([](const NodePair& pair) { return pair.distance; }),
          gathered([](const NodePair& pair) { return pair.gradient[0]; }),
          gathered([](const NodePair& pair) { return pair.gradient[1]; }),
          gathered([](const NodePair& pair) { return pair.gradient[2]; })};
#endif
}

template <int i>
Floats spread(const Floats& pack) {
  return __builtin_shufflevector(pack, pack, i, i, i, i);
}
inline float sum_of(const Floats& pack) {
  const Floats halves = pack + __builtin_shufflevector(pack, pack, 2, 3, 2, 3);
  return halves[0] + halves[1];
}

}  // namespace node_blend

/// Distance in cells and its gradient, by the eight nodes around a point. `first`: the pair of the least
/// coordinates; `weights`: where the point is between the nodes along x, y and z, 0 to kWeightOne, and 0.
///
/// Trilinear; `cubic`: right for polynomials of third order. Along each axis Hermite's cubic by distance
/// and slope of both nodes, across it linear; what it adds to a linear blend is summed over the axes (a
/// Boolean sum without its mixed parts, after Gordon 1971). The gradient is the linear blend of the nodes'
/// gradients.
///
/// Between two nodes with the distances p and q and the slopes m and n the cubic is, with u = t (1-t) and
/// v = 1-2t,  (1-t) p + t q  +  u v (p - q)  +  u ((1-t) m - t n).  So each node's number has one weight,
/// which needs no node: they are made while the nodes come from memory.
///
/// The blend along x is made of whole numbers and has no rounding, the rest is float: the result is off by
/// less than 2^-13 of a cell's side and 2^-20 of the largest distance.
template <bool kCubic>
[[gnu::always_inline]] inline lanes::Pack<float> blend(const NodePair* first,
                                                       const NodeLayout& layout,
                                                       const lanes::Flags<float>& weights) {
  using namespace node_blend;
  constexpr float kOne = 1.0F / kWeightOne;
  constexpr Floats kSignsY = {-1, 1, -1, 1}, kSignsZ = {-1, -1, 1, 1};
  const Around nodes = around(first, layout);
  const Integers x = __builtin_shufflevector(weights, weights, 0, 0, 0, 0);
  const auto along_x = [&](const Pairs& pairs) { return sums(pairs, kWeightOne - x, x); };
  const Floats t = kOne * __builtin_convertvector(weights, Floats);
  const Floats by_y = Floats{1, 0, 1, 0} + kSignsY * spread<1>(t);
  const Floats by_z = Floats{1, 1, 0, 0} + kSignsZ * spread<2>(t);
  const Floats linear = by_y * by_z;
  const Floats distances = along_x(nodes.distance);
  const auto slope = [&](const Pairs& slopes) {
    return kOne / kGradientScale * sum_of(linear * along_x(slopes));
  };
  const float step = kOne * layout.step;
  float distance;
  if constexpr (kCubic) {
    const Floats u = t - t * t;
    const Floats uv = u - (t + t) * u;
    const Floats of_slopes = lanes::all(kOne * layout.slope) * u;
    const Floats of_distances =
        (by_y - kSignsY * spread<1>(uv)) * by_z - by_y * (kSignsZ * spread<2>(uv));
    constexpr Integers kOnes = {kWeightOne, kWeightOne, kWeightOne, kWeightOne};
    const Floats rises = sums(nodes.distance, -kOnes, kOnes);
    const Floats slopes_x = sums(nodes.slope_x, kWeightOne - x, -x);
    const Floats of_linear =
        spread<0>(of_slopes) * slopes_x - kSignsY * spread<1>(of_slopes) * along_x(nodes.slope_y) -
        kSignsZ * spread<2>(of_slopes) * along_x(nodes.slope_z) - step * spread<0>(uv) * rises;
    distance = sum_of(step * of_distances * distances + linear * of_linear);
  } else {
    distance = step * sum_of(linear * distances);
  }
  return Floats{distance, slope(nodes.slope_x), slope(nodes.slope_y), slope(nodes.slope_z)};
}

}  // namespace contactscope

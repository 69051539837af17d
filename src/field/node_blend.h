#pragma once

#include "core/pack.h"

/// Lattice nodes, rounded to 16 bits, and their blend, which takes most of a distance field query.
namespace contactscope {

/// A rounded node: its distance in steps of the field, the gradient in kGradientScale, all even.
struct FieldNode {
  std::int16_t distance;
  std::array<std::int16_t, 3> gradient;
};

/// Two neighbouring nodes along x, the lower one first, as a blend reads them.
struct alignas(16) NodePair {
  NodePair() = default;
  NodePair(const FieldNode& near, const FieldNode& far) {
#ifdef __SSE2__
    _mm_store_si128(reinterpret_cast<__m128i*>(this),
                    _mm_unpacklo_epi16(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(&near)),
                                       _mm_loadl_epi64(reinterpret_cast<const __m128i*>(&far))));
#else
    distance = {near.distance, far.distance};
    for (std::size_t axis = 0; axis < 3; ++axis)
      gradient[axis] = {near.gradient[axis], far.gradient[axis]};
#endif
  }

  std::array<std::int16_t, 2> distance;
  /// The last number is odd if the cell that begins with these two nodes uses its triangles.
  std::array<std::array<std::int16_t, 2>, 3> gradient;
  bool queries_triangles() const { return (gradient[2][1] & 1) != 0; }
  void query_triangles() { gradient[2][1] = static_cast<std::int16_t>(gradient[2][1] | 1); }
};

inline constexpr float kGradientScale = 32766;
inline constexpr double kMaxSteps = 32767;

/// Rounds distance and gradient: 0.5 steps, and less than 0.01 from float rounding.
inline FieldNode rounded_node(const lanes::Pack<float>& node, float steps_per_cell) {
  lanes::Pack<float> scale = lanes::all(0.5F * kGradientScale);
  scale[0] = steps_per_cell;
  const lanes::Pack<float> most = lanes::all(static_cast<float>(kMaxSteps));
  const lanes::Pack<float> scaled = lanes::larger(-most, lanes::smaller(most, node * scale));
  constexpr lanes::Flags<float> kOfGradient = {0, -1, -1, -1};
  FieldNode rounded;
#ifdef __SSE2__
  const auto whole =
      reinterpret_cast<lanes::Flags<float>>(_mm_cvtps_epi32(reinterpret_cast<__m128>(scaled)));
  const auto even = reinterpret_cast<__m128i>(whole + (whole & kOfGradient));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(&rounded), _mm_packs_epi32(even, even));
#else
  const auto even = [&](int lane) {
    const auto whole = static_cast<int>(std::lrintf(scaled[lane]));
    return static_cast<std::int16_t>(whole + (whole & kOfGradient[lane]));
  };
  rounded = {even(0), {even(1), even(2), even(3)}};
#endif
  return rounded;
}
inline constexpr double kNodeRounding = 0.51;  // steps

/// Bits of a blend's weights: a point is rounded by up to 2^-14 of a cell.
inline constexpr int kWeightBits = 14;
inline constexpr int kWeightOne = 1 << kWeightBits;

/// Memory layout and units of node pairs, of the coarse nodes or of a fine block.
struct NodeLayout {
  NodeLayout() = default;
  /// `row` and `layer`: offset of the next pair along y and z; along x it is 1. Nodes are 2^`side`
  /// cells from each other. `most`: largest distance, cells.
  NodeLayout(std::ptrdiff_t row, std::ptrdiff_t layer, int side, float most)
      : next_y(row),
        next_z(layer),
        step(most / static_cast<float>(kMaxSteps)),
        rise(static_cast<float>(1 << side) / (kGradientScale * step)),
        side_bits(side) {
    constexpr float kPart = 1.0F / kWeightOne;
    counts = lanes::all(kPart / kGradientScale);
    counts[0] = kPart * step;
  }

  lanes::Pack<float> counts{};  // units of a node's numbers, after multiplication by weights
  std::ptrdiff_t next_y = 0, next_z = 0;
  float step = 1;  // unit of a distance, cells
  float rise = 1;  // unit of a gradient from node to node, steps
  int side_bits = 0;
};

namespace node_blend {

using Floats = lanes::Pack<float>;
using Integers = lanes::Flags<float>;

#ifdef __SSE2__
/// A point in parts of a cell, kWeightOne of them, and 0. Values beyond int become negative.
inline Integers parts_of(const Vec3d& point) {
  const __m128d unit = _mm_set1_pd(kWeightOne);
  const __m128i xy = _mm_cvttpd_epi32(_mm_mul_pd(_mm_loadu_pd(point.data()), unit));
  const __m128i z = _mm_cvttpd_epi32(_mm_mul_pd(_mm_load_sd(point.data() + 2), unit));
  return reinterpret_cast<Integers>(_mm_unpacklo_epi64(xy, z));
}
/// Lane i, a number from 0 to 2^16 - 1.
template <int i> int small_lane(const Integers& numbers) {
  return _mm_extract_epi16(reinterpret_cast<__m128i>(numbers), 2 * i);
}
/// 16-bit weights of the near and the far node, for each of the four numbers.
using PairWeights = __m128i;
inline PairWeights pair_weights(const Integers& near, const Integers& far) {
  return reinterpret_cast<__m128i>((far << 16) | (near & 0xffff));
}
/// The weighted sums of the two nodes' numbers.
inline Floats sums(const NodePair& pair, const PairWeights& weights) {
  const __m128i numbers = _mm_load_si128(reinterpret_cast<const __m128i*>(&pair));
  return _mm_cvtepi32_ps(_mm_madd_epi16(numbers, weights));
}
#else
inline Integers parts_of(const Vec3d& point) {
  const auto part = [&](int axis) {
    const double scaled = kWeightOne * point[axis];
    return std::abs(scaled) < 0x1p31 ? static_cast<int>(scaled) : -1;
  };
  return Integers{part(0), part(1), part(2), 0};
}
template <int i> int small_lane(const Integers& numbers) { return numbers[i]; }
struct PairWeights {
  Integers near, far;
};
inline PairWeights pair_weights(const Integers& near, const Integers& far) { return {near, far}; }
inline Floats sums(const NodePair& pair, const PairWeights& weights) {
  const auto& [distance, gradient] = pair;
  const Integers near = {distance[0], gradient[0][0], gradient[1][0], gradient[2][0]};
  const Integers far = {distance[1], gradient[0][1], gradient[1][1], gradient[2][1]};
  return __builtin_convertvector(weights.near * near + weights.far * far, Floats);
}
#endif

template <int i> Floats spread(const Floats& pack) {
  return __builtin_shufflevector(pack, pack, i, i, i, i);
}
/// Interpolates from `near` to `far`.
inline Floats between(const Floats& near, const Floats& far, const Floats& t) {
  return near + t * (far - near);
}

}  // namespace node_blend

/// Distance in cells and its gradient, from the eight nodes around a point. `first`: the pair with
/// the lowest coordinates; `weights`: place in the cell along x, y and z, 0 to kWeightOne, and 0.
///
/// Trilinear; `cubic`: exact for polynomials of third order. Along each axis Hermite's cubic of
/// both nodes' distances and slopes; differences from a linear blend are summed over the axes (a
/// Boolean sum without its mixed parts, after Gordon 1971). The gradient is the linear blend.
///
/// The four numbers of a node are blended side by side: along x by pairs, then rows along y and z.
///
/// Between nodes with distances p and q and slopes m and n the cubic is, for u = t (1-t), v = 1-2t,
/// (1-t) p + t q  +  u v (p - q)  +  u ((1-t) m - t n).  Each number has one weight that needs no
/// node, so weights are computed while the nodes are loaded from memory.
///
/// The blend along x uses integers without rounding, the rest is float: the error is less than
/// 2^-13 of a cell's side and 2^-20 of the largest distance.
template <bool kCubic>
[[gnu::always_inline]] inline lanes::Pack<float> blend(const NodePair* first,
                                                       const NodeLayout& layout,
                                                       const lanes::Flags<float>& weights) {
  using namespace node_blend;
  constexpr float kOne = 1.0F / kWeightOne;
  const NodePair* far = first + layout.next_z;
  const std::array<const NodePair*, 4> rows = {first, first + layout.next_y, far,
                                               far + layout.next_y};
  const Integers x = __builtin_shufflevector(weights, weights, 0, 0, 0, 0);
  const PairWeights by_x = pair_weights(kWeightOne - x, x);
  const Floats t = kOne * __builtin_convertvector(weights, Floats);
  const Floats y = spread<1>(t), z = spread<2>(t);
  const std::array<Floats, 4> row = {sums(*rows[0], by_x), sums(*rows[1], by_x),
                                     sums(*rows[2], by_x), sums(*rows[3], by_x)};
  const Floats near_z = between(row[0], row[1], y), far_z = between(row[2], row[3], y);
  Floats node = between(near_z, far_z, z);
  if constexpr (kCubic) {
    // Along x, which needs the separate nodes: p - q, and (1-t) m - t n.
    constexpr Integers kOfDistance = {-1, 0, 0, 0}, kOfSlope = {0, -1, 0, 0};
    const Integers cubic_near = (kOfDistance & kWeightOne) | (kOfSlope & (kWeightOne - x));
    const Integers cubic_far = (kOfDistance & -kWeightOne) | (kOfSlope & -x);
    const PairWeights cubic_by_x = pair_weights(cubic_near, cubic_far);
    const auto along_x = [&](std::size_t i) { return sums(*rows[i], cubic_by_x); };
    const Floats of_x =
        between(between(along_x(0), along_x(1), y), between(along_x(2), along_x(3), y), z);
    // Along y and z: distance and slope of the near side, then of the far side.
    const Floats near_y = between(row[0], row[2], z), far_y = between(row[1], row[3], z);
    const Floats near = __builtin_shufflevector(near_y, near_z, 0, 2, 4, 7);
    const Floats far_side = __builtin_shufflevector(far_y, far_z, 0, 2, 4, 7);
    const Floats yzx = __builtin_shufflevector(t, t, 1, 2, 0, 3);
    const Floats u = yzx - yzx * yzx;
    const Floats uv = u - (yzx + yzx) * u;
    const Floats slope = lanes::all(layout.rise) * u;
    const Floats far_slope = slope * yzx;
    const Floats near_weights = __builtin_shufflevector(uv, slope - far_slope, 0, 4, 1, 5);
    const Floats far_weights = __builtin_shufflevector(uv, far_slope, 0, 4, 1, 5);
    const Floats x_weights = __builtin_shufflevector(uv, slope, 2, 6, 3, 7);
    const Floats added = near * near_weights - far_side * far_weights + of_x * x_weights;
    const Floats halves = added + __builtin_shufflevector(added, added, 2, 3, 2, 3);
    node[0] += halves[0] + halves[1];
  }
  return node * layout.counts;
}

}  // namespace contactscope

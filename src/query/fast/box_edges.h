#pragma once

#include "query/fast/packed_vectors.h"

/// Two crossing edges of boxes: their indices, separation along the cross product, and closest
/// points. Bitwise equal to query_edges() and closest_points() for hulls. An edge of A is parallel
/// to a coordinate axis, so its products are entries of the other vector.
namespace contactscope::boxes {

template <class S> [[gnu::always_inline]] inline S dot(const Three<S>& a, const Three<S>& b) {
  const Three<S> products = a * b;
  return dot_sum<S>(S(products[0]), S(products[1]), S(products[2]));
}

/// A vertex of B in A's frame. For all vertices, VerticesOfB is cheaper.
template <class S>
[[gnu::always_inline]] inline Three<S> vertex_of_b(const BoxPair<S>& pair, int vertex) {
  const Three<S> signs =
      lanes::load_pack<Three<S>>(kVertexSigns<S>[static_cast<std::size_t>(vertex)].data());
  const auto& [x, y, z] = pair.arms.of;
  return ((x * spread<0>(signs) + y * spread<1>(signs)) + z * spread<2>(signs)) + pair.offset;
}

/// Two edges that are support features along the cross product of axis i of A and axis j of B, or
/// its opposite if `against`. As in the general path: A's half-edge is even, and B's runs in the
/// direction of A's arc on the Gauss map, from the normal of its left face (gauss_map.h).
struct CrossedEdges {
  int edge_a, edge_b;  // half-edges
};

template <class S>
[[gnu::always_inline]] inline CrossedEdges edges_along(const BoxPair<S>& pair, int i, int j,
                                                       int against) {
  const auto next_of = [](int axis) { return (0b00'10'01 >> (2 * axis)) & 3; };
  const int i1 = next_of(i), i2 = next_of(i1), j1 = next_of(j), j2 = next_of(j1);
  // Bit k: entry k of the column or row is below (above) zero.
  const auto below = [](const Three<S>& v) {
    return static_cast<int>(lane_bits<S>(v < Three<S>{}));
  };
  const auto above = [](const Three<S>& v) {
    return static_cast<int>(lane_bits<S>(v > Three<S>{}));
  };
  const Three<S>&column = pair.columns.of[j], &row = pair.rows.of[i];
  const int down = below(column);
  // The cross product of axis i of A and axis j of B, or its opposite, as signs along A's axes and
  // along B's axes. B's vertex is in the opposite direction.
  const int vertex_a = ((down >> i2 ^ against) & 1) << i1 | ((above(column) >> i1 ^ against) & 1)
                                                                << i2;
  const int vertex_b = ((below(row) >> j2 ^ against) & 1) << j1 | ((above(row) >> j1 ^ against) & 1)
                                                                      << j2;
  const int edge_a =
      kBox.leaving[static_cast<std::size_t>(vertex_a)][static_cast<std::size_t>(i)] & ~1;
  const int second = kBox.face(edge_a ^ 1);                // +x, -x, ...
  const int falls = (down >> (second >> 1) ^ second) & 1;  // B's axis runs against its normal
  const int from_b = vertex_b | (falls ^ 1) << j;
  return {edge_a, kBox.leaving[static_cast<std::size_t>(from_b)][static_cast<std::size_t>(j)]};
}

/// Unit vectors along the axes, wrapping around.
template <class S>
inline constexpr std::array<std::array<S, 4>, 5> kUnits = {
    {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}};
template <class S> [[gnu::always_inline]] inline Three<S> unit(int i) {
  return lanes::load_pack<Three<S>>(kUnits<S>[static_cast<std::size_t>(i)].data());
}

/// Measurement of two crossed edges, A's frame.
template <class S> struct EdgeMeasure {
  Three<S> normal;  // unit, from A to B
  S separation;     // metres
  Three<S> middle;  // midpoint of their closest points
};

/// Measures edges_along(pair, i, j, against). `direction`: B's axis j; `over_sine`: of the edges.
template <class S>
[[gnu::always_inline]] inline EdgeMeasure<S> measure(const BoxPair<S>& pair,
                                                     const CrossedEdges& edges, int i, int j,
                                                     int against, const Three<S>& direction,
                                                     S over_sine) {
  constexpr S kSigns[] = {S(1), S(-1)};  // of an edge with or against the direction of its axis
  const int vertex_a = kBox.origin(edges.edge_a), vertex_b = kBox.origin(edges.edge_b);
  const S up_a = kSigns[vertex_a >> i & 1], up_b = kSigns[vertex_b >> j & 1];
  // The cross product of the axes. That of the edges has the same or the opposite sign.
  const Three<S> axes = unit<S>(i + 2) * after_next(direction) - unit<S>(i + 1) * next(direction);
  const Three<S> u = unit<S>(i) * up_a, v = direction * up_b, c = axes * (up_a * up_b);
  const Three<S> from_a = vertex_of_box<S>(pair.half_a, vertex_a);
  const Three<S> from_b = vertex_of_b(pair, vertex_b), to_b = vertex_of_b(pair, vertex_b ^ 1 << j);
  const Three<S> between = from_b - from_a;

  EdgeMeasure<S> result;
  result.normal = axes * (kSigns[against] * over_sine);
  result.separation = dot<S>(result.normal, between);
  // The same computation as closest_points().
  const auto within = [](S value, S most) __attribute__((always_inline)) {
    return std::min(std::max(value, S(0)), most);
  };
  const S length_a = S(2) * pair.a.half_extents[i];
  const S length_b = dot<S>(v, to_b - from_b);
  S along_a = within(dot<S>(cross<S>(between, v), c) / dot<S>(c, c), length_a);
  const S along_b = within(dot<S>(v, from_a + along_a * u - from_b), length_b);
  const Three<S> on_b = from_b + along_b * v;
  along_a = within(dot<S>(u, on_b - from_a), length_a);
  result.middle = S(0.5) * ((from_a + along_a * u) + on_b);
  return result;
}

}  // namespace contactscope::boxes

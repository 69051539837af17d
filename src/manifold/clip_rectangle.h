#pragma once

#include <bit>
#include <cstdint>

#include "manifold/clip.h"
#include "query/box_pair.h"

/// clip() for a rectangle against the four side planes of another, without a branch on which corner lies
/// where. The same corners in the same order with the same bits as four calls of clip() would leave.
///
/// Sutherland and Hodgman 1974 go round the polygon once for each plane and ask of each corner whether
/// it is outside. Here each corner is asked once, when it is made, about all four planes at a time, and
/// keeps the answers as four bits: its outcode (Cohen and Sutherland; Newman and Sproull 1973). The
/// polygon is a list of bytes in two words, eight corners at most. Outside of one plane is one run of
/// the list, as both rectangles are convex:
///
///     list   p0 p1 p2 p3 p4        e: the last corner before the run, whose edge leaves
///     out     0  1  1  0  0        r: the last of the run, whose edge comes back
///            e^    r^              p0 [crossing of e] [crossing of r] p3 p4
///
/// Bit operations find both and splice the list. Positions stay where they are made.
namespace contactscope::boxes {

/// What is clipped. Three packs have a lane for a coordinate; `side` has one for each side plane.
template <class S>
struct RectanglePair {
  Three<S> corners[4];  // of the incident face, in the order of its ring, A's frame, metres
  Three<S> side_x, side_y, side_z, side_offset;  // unit normals, outward
  S thickness;                                   // metres, see clip()
};

/// What is left. Corner i is positions[place(i)]; the two edges that cross there are below 4 an edge of
/// the incident face, else 4 + a side, both in the order of their rings.
template <class S>
struct ClippedRectangle {
  static constexpr int kPlaces = 4 + 2 * 4;  // a side makes two corners at most

  int place(int i) const { return static_cast<int>(list >> (8 * i) & 15U); }

  int count = 0;
  std::uint64_t list = 0;  // a byte a corner: its place, and in the upper half the edge that leaves
  Three<S> positions[kPlaces];
  std::uint8_t crossings[kPlaces];  // two edges of four bits
};

/// A byte a corner: outside of which sides it lies, and in the upper half strictly inside of which.
template <class S>
[[gnu::always_inline]] inline std::uint64_t outcode(const Three<S>& distances, S thickness) {
  return lane_bits<S>(distances > thickness) | lane_bits<S>(distances < -thickness) << 4;
}

/// The first `bits` bits, below 64.
constexpr std::uint64_t low(int bits) {
  return (std::uint64_t{1} << bits) - 1;
}

/// Of a list, the run of corners outside of one side; see above. In bits, eight for each corner.
struct OutsideRun {
  int end;                       // of the list
  int leaves;                    // e
  int returns;                   // r
  bool has_first;                // the run has the first corner of the list
  bool crosses_out, crosses_in;  // e, and what follows r, are not on the plane but inside

  /// A list of bytes with those of the two crossings spliced in. A corner stays where it was in the order;
  /// the list begins with the way back where the run has its first corner.
  std::uint64_t splice(std::uint64_t bytes, std::uint64_t out, std::uint64_t in) const {
    const int kept_from = returns + 8, kept_to = leaves + 8;
    out = crosses_out ? out : 0;
    in = crosses_in ? in : 0;
    const int out_bits = crosses_out ? 8 : 0, in_bits = crosses_in ? 8 : 0;
    if (has_first) {
      const std::uint64_t kept = (bytes & low_or_all(kept_to)) >> kept_from;
      return in | kept << in_bits | shifted(out, in_bits + kept_to - kept_from);
    }
    const std::uint64_t tail = kept_from < 64 ? bytes >> kept_from : 0;
    return (bytes & low(kept_to)) | out << kept_to | shifted(in, kept_to + out_bits) |
           shifted(tail, kept_to + out_bits + in_bits);
  }
  int count() const {
    const int kept = has_first ? leaves - returns : end - (returns - leaves);
    return kept / 8 + static_cast<int>(crosses_out) + static_cast<int>(crosses_in);
  }

 private:
  static constexpr std::uint64_t low_or_all(int bits) { return ~std::uint64_t{0} >> (64 - bits); }
  static constexpr std::uint64_t shifted(std::uint64_t bytes, int bits) {
    return bits < 64 ? bytes << bits : 0;
  }
};

/// False where the run is not one: rounding of a sliver. clip() knows what to do.
template <class S>
[[gnu::always_inline]] inline bool clip_rectangle(const RectanglePair<S>& pair,
                                                  ClippedRectangle<S>& result) {
  Three<S> distances[ClippedRectangle<S>::kPlaces];
  std::uint64_t codes = 0;
  const auto put = [&](int place, const Three<S>& position) __attribute__((always_inline)) {
    const Three<S> along = dot_sum<S>(Three<S>(pair.side_x * spread<0>(position)),
                                      Three<S>(pair.side_y * spread<1>(position)),
                                      Three<S>(pair.side_z * spread<2>(position)));
    result.positions[place] = position;
    distances[place] = along - pair.side_offset;
    return outcode<S>(distances[place], pair.thickness);
  };
  for (int i = 0; i < 4; ++i) {
    codes |= put(i, pair.corners[i]) << (8 * i);
    result.crossings[i] = static_cast<std::uint8_t>((i + 3) % 4 | i << 4);
  }
  std::uint64_t list = 0x33221100U;
  int count = 4, places = 4;
  for (int side = 0; side < 4; ++side) {
    constexpr std::uint64_t kOneEach = 0x0101010101010101U;
    const int end = 8 * count;
    const std::uint64_t valid = kOneEach >> (64 - end);
    const std::uint64_t outside = codes >> side & valid;
    if (outside == 0) continue;
    if (outside == valid) {
      count = 0;
      break;
    }
    const std::uint64_t follows = outside >> 8 | (outside & 1U) << (end - 8);
    const std::uint64_t leaving = ~outside & follows, returning = outside & ~follows;
    if ((leaving & (leaving - 1)) != 0) [[unlikely]]
      return false;
    OutsideRun run;
    run.end = end;
    run.leaves = std::countr_zero(leaving);
    run.returns = std::countr_zero(returning);
    run.has_first = (outside & 1U) != 0;
    const auto next = [end](int at) { return at + 8 == end ? 0 : at + 8; };
    const int inside = side + 4;
    run.crosses_out = (codes >> (run.leaves + inside) & 1U) != 0;
    run.crosses_in = (codes >> (next(run.returns) + inside) & 1U) != 0;

    const auto cross = [&](int at) __attribute__((always_inline)) {
      const auto p = list >> at & 15U, q = list >> next(at) & 15U;
      const S p_distance = distances[p][side], q_distance = distances[q][side];
      const S fraction = p_distance / (p_distance - q_distance);
      return Three<S>(result.positions[p] + fraction * (result.positions[q] - result.positions[p]));
    };
    const std::uint64_t side_edge = static_cast<std::uint64_t>(4 + side);
    const std::uint64_t out_edge = list >> (run.leaves + 4) & 15U;
    const std::uint64_t in_edge = list >> (run.returns + 4) & 15U;
    const auto out = static_cast<std::uint64_t>(places), in = out + 1;
    const Three<S> crossing_out = cross(run.leaves), crossing_in = cross(run.returns);
    const std::uint64_t out_code = put(places, crossing_out);
    const std::uint64_t in_code = put(places + 1, crossing_in);
    result.crossings[out] = static_cast<std::uint8_t>(out_edge | side_edge << 4);
    result.crossings[in] = static_cast<std::uint8_t>(in_edge | side_edge << 4);
    places += 2;
    if (!run.crosses_out) {
      // It is on the plane: the polygon goes on along the side from there.
      list = (list & ~(std::uint64_t{15} << (run.leaves + 4))) | side_edge << (run.leaves + 4);
    }
    list = run.splice(list, out | side_edge << 4, in | in_edge << 4);
    codes = run.splice(codes, out_code, in_code);
    count = run.count();
    if (count > 8) [[unlikely]]
      return false;
  }
  result.count = count;
  result.list = list;
  return true;
}

}  // namespace contactscope::boxes

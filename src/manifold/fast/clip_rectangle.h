#pragma once

#include "manifold/clip.h"
#include "query/fast/box_pair.h"

/// clip() for a rectangle against the four side planes of another, without branches on the corners'
/// positions. Gives the same corners in the same order with the same bits as four calls of clip().
///
/// Sutherland and Hodgman 1974 traverse the polygon once per plane and test each corner. Here each
/// new corner is tested once against all four planes, and keeps the results as four bits: its
/// outcode (Cohen and Sutherland; Newman and Sproull 1973). The polygon is a list of bytes in two
/// words, at most eight corners. The corners outside one plane are one run of the list, because
/// both rectangles are convex:
///
///     list   p0 p1 p2 p3 p4        e: the last corner before the run, whose edge leaves
///     out     0  1  1  0  0        r: the last of the run, whose edge comes back
///            e^    r^              p0 [crossing of e] [crossing of r] p3 p4
///
/// Bit operations find both edges and splice the list, which may rotate. Positions are not moved.
namespace contactscope::boxes {

/// Two rectangles. A triangle lacks the fourth corner, or has a fourth side that excludes nothing.
/// Three packs have a lane per coordinate; `side` has one per side plane.
template <class S> struct RectanglePair {
  Three<S> corners[4];  // of the incident face, in the order of its ring, A's frame, metres
  Three<S> side_x, side_y, side_z, side_offset;  // unit normals, outward
  S thickness;                                   // metres, see clip()
};

/// The result. Corner i is positions[place(i)]. Its two edges in `crossings` are those of the
/// incident face (below 4) or sides (4 + side), both in the order of their rings.
template <class S> struct ClippedRectangle {
  static constexpr int kPlaces = 4 + 2 * 4;  // a side makes two corners at most
  int place(int i) const { return static_cast<int>(list >> (8 * i) & 15U); }

  int count = 0;
  std::uint64_t list = 0;  // a byte per corner: its place; upper half: the edge that starts there
  Three<S> positions[kPlaces];
  std::uint8_t crossings[kPlaces];  // two edges of four bits each
};

/// A byte per corner: which sides it is outside of; upper half: strictly inside of.
template <class S>
[[gnu::always_inline]] inline std::uint64_t outcode(const Three<S>& distances, S thickness) {
  return lane_bits<S>(distances > thickness) | lane_bits<S>(distances < -thickness) << 4;
}

/// The run of a list's corners outside one side; see above. Positions: in bits, eight per corner.
struct OutsideRun {
  int end;                       // end of the list
  int after;                     // the corner that follows the run
  int kept;                      // length of the rest of the list
  bool crosses_out, crosses_in;  // the corners before and after it are strictly inside

  /// Rotates a list of bytes to start after the run; replaces the run by the crossings' bytes.
  std::uint64_t splice(std::uint64_t bytes, std::uint64_t out, std::uint64_t in) const {
    const std::uint64_t turned = bytes >> after | bytes << 1 << (end - after - 1);
    const std::uint64_t crossings = (crosses_out ? out | in_bits(in) << 8 : in_bits(in));
    return (turned & ((std::uint64_t{1} << kept) - 1)) | crossings << kept;
  }
  /// New position of a corner that is not in the run.
  int moved(int at) const { return at < after ? at - after + end : at - after; }
  /// Start of the part that replaces the list's first corner if that is outside.
  int return_steps() const { return crosses_in ? kept + (crosses_out ? 8 : 0) : 0; }
  int new_end() const { return kept + (crosses_out ? 8 : 0) + (crosses_in ? 8 : 0); }

 private:
  std::uint64_t in_bits(std::uint64_t in) const { return crosses_in ? in : 0; }
};

/// Returns false if rounding of a sliver breaks the run; then use clip(). `kCorners`: 4 or 3.
template <int kCorners = 4, class S>
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
  for (int i = 0; i < kCorners; ++i) {
    codes |= put(i, pair.corners[i]) << (8 * i);
    result.crossings[i] = static_cast<std::uint8_t>((i + kCorners - 1) % kCorners | i << 4);
  }
  std::uint64_t list = 0x33221100U & (~std::uint64_t{0} >> (64 - 8 * kCorners));
  int end = 8 * kCorners, first = 0,
      places = kCorners;  // `first`: position of the first corner, the list may start anywhere
  for (int side = 0; side < 4; ++side) {
    constexpr std::uint64_t kOneEach = 0x0101010101010101U;
    const std::uint64_t valid = kOneEach >> (64 - end);
    const std::uint64_t outside = codes >> side & valid;
    if (outside == 0) continue;
    if (outside == valid) {
      end = 0;
      break;
    }
    const std::uint64_t follows = outside >> 8 | (outside & 1U) << (end - 8);
    const std::uint64_t leaving = ~outside & follows, returning = outside & ~follows;
    if ((leaving & (leaving - 1)) != 0) [[unlikely]]
      return false;
    const auto next = [end](int at) { return at + 8 == end ? 0 : at + 8; };
    const int leaves = std::countr_zero(leaving), returns = std::countr_zero(returning);
    OutsideRun run;
    run.end = end;
    run.after = next(returns);
    run.kept = run.moved(leaves) + 8;
    const std::uint64_t inside = codes >> (side + 4);
    run.crosses_out = (inside >> leaves & 1U) != 0;
    run.crosses_in = (inside >> run.after & 1U) != 0;

    const auto cross = [&](int from, int to) __attribute__((always_inline)) {
      const auto p = list >> from & 15U, q = list >> to & 15U;
      const S p_distance = distances[p][side], q_distance = distances[q][side];
      const S fraction = p_distance / (p_distance - q_distance);
      return Three<S>(result.positions[p] + fraction * (result.positions[q] - result.positions[p]));
    };
    const Three<S> crossing_out = cross(leaves, next(leaves));
    const Three<S> crossing_in = cross(returns, run.after);
    const std::uint64_t out_code = put(places, crossing_out);
    const std::uint64_t in_code = put(places + 1, crossing_in);
    const std::uint64_t side_edge = static_cast<std::uint64_t>(4 + side);
    const std::uint64_t out_edge = list >> (leaves + 4) & 15U;
    const std::uint64_t in_edge = list >> (returns + 4) & 15U;
    const auto out = static_cast<std::uint64_t>(places), in = out + 1;
    result.crossings[out] = static_cast<std::uint8_t>(out_edge | side_edge << 4);
    result.crossings[in] = static_cast<std::uint8_t>(in_edge | side_edge << 4);
    places += 2;
    // From a corner on the plane the polygon continues along the side itself.
    const std::uint64_t turns = run.crosses_out ? 0 : (out_edge ^ side_edge) << (leaves + 4);
    list = run.splice(list ^ turns, out | side_edge << 4, in | in_edge << 4);
    codes = run.splice(codes, out_code, in_code);
    first = (outside >> first & 1U) != 0 ? run.return_steps() : run.moved(first);
    end = run.new_end();
    if (end > 64) [[unlikely]]
      return false;
  }
  result.count = end / 8;
  result.list = end == 0 ? 0 : list >> first | list << 1 << (end - first - 1);
  return true;
}

}  // namespace contactscope::boxes

#pragma once

#include "query/fast/box_edges.h"
#include "query/sat.h"
#include "query/tolerance.h"

/// The separating axis test for two boxes: six faces and nine cross products (Gottschalk, Lin and
/// Manocha 1996). The choice follows sat() for hulls (Gregorius 2015, "Hull vs Hull: The Separating
/// Axis Test"). Face axes have bitwise equal separations. Edge axes are first estimated with an
/// error bound, three per register. An edge pair that wins is measured again as in sat().
///
/// If rounding would decide, the result is Undecided, and the caller takes the general path, which
/// depends on the order of the axes. So both paths always agree.
namespace contactscope::boxes {

enum class Verdict {
  Separated,  // by more than `margin`
  Face,       // `face` of the box `reference` makes the contact
  Edge,       // `edge` makes the contact
  Undecided,
};

template <class S> struct BoxAxis {
  Verdict verdict = Verdict::Undecided;
  Owner reference = Owner::A;
  FaceQuery<S> face{};    // its support vertex is not set
  CrossedEdges edges;     // if Edge
  EdgeMeasure<S> edge;    // if Edge
  Columns<S> directions;  // of B's axes, unless the boxes are separated
  S deepest = 0;          // metres: largest separation of all axes, or a lower value if irrelevant
};

/// Face with the largest separation of one of two boxes.
template <class S> struct BestFace {
  bool unique;  // the general path chooses this face, regardless of the order
  int face;
  S separation;
};

/// `up` and `down`: separations along three axes and their opposites, lower in the fourth lane.
template <class S>
[[gnu::always_inline]] inline BestFace<S> best_face(const Three<S>& up, const Three<S>& down,
                                                    S tie) {
  const Three<S> most = lanes::largest<S>(lanes::larger(up, down));
  const std::uint32_t ups = lane_bits<S>(up + tie >= most);
  const std::uint32_t downs = lane_bits<S>(down + tie >= most);
  const std::uint32_t near = ups | downs << 4;
  const int lane = std::countr_zero(near | 0x100U);
  return {(near & (near - 1)) == 0, 2 * (lane & 3) + (lane >> 2), most[0]};
}

template <class S>
[[gnu::always_inline]] inline BestFace<S> query_faces_of_a(const BoxPair<S>& pair, S tie) {
  const Three<S> reach =
      (absolute<S>(pair.arms.of[0]) + absolute<S>(pair.arms.of[1])) + absolute<S>(pair.arms.of[2]);
  return best_face<S>((pair.offset - reach) - pair.half_a, -(pair.offset + reach) - pair.half_a,
                      tie);
}

/// Offset of B's centre from A's origin along each axis of B.
template <class S> [[gnu::always_inline]] inline Three<S> middle_of_b(const BoxPair<S>& pair) {
  return (pair.rows.of[0] * spread<0>(pair.offset) + pair.rows.of[1] * spread<1>(pair.offset)) +
         pair.rows.of[2] * spread<2>(pair.offset);
}

template <class S>
[[gnu::always_inline]] inline BestFace<S> query_faces_of_b(const BoxPair<S>& pair, S tie) {
  const Three<S> reach = (absolute<S>(pair.rows.of[0] * spread<0>(pair.half_a)) +
                          absolute<S>(pair.rows.of[1] * spread<1>(pair.half_a))) +
                         absolute<S>(pair.rows.of[2] * spread<2>(pair.half_a));
  const Three<S> middle = middle_of_b(pair);
  return best_face<S>(-reach - (pair.half_b + middle), -reach - (pair.half_b - middle), tie);
}

/// Cross products of the three axes of A with axis j of B: three of the nine.
template <class S> struct Crosses {
  Three<S> offset;  // B's centre along the cross product: the sign gives the direction from A to B
  Three<S> sine, over_sine;  // length of the cross product, and 1 over it
  Three<S> lower, upper;     // metres: bounds of the separation along it
};

/// `off` bounds the error of a separation times the sine. Nearly parallel edges make a sliver of
/// the Minkowski difference. No axis of it beats the adjacent faces by more than its width
/// (tolerance.h), `sliver` (metres) times the sine. Proof: turn B until the edges are parallel. The
/// axes perpendicular to both are then those of two rectangles, where a face is best; supports have
/// moved by the sine times a radius, and normals by the sine.
template <int kJ, class S>
[[gnu::always_inline]] inline Crosses<S> crosses(const BoxPair<S>& pair,
                                                 const Columns<S>& directions, S off, S floor,
                                                 S sliver) {
  constexpr int kNext = (kJ + 1) % 3, kAfter = (kJ + 2) % 3;
  const Three<S>& column = directions.of[kJ];
  const Three<S> size = absolute<S>(column);
  const Three<S> offset =
      next(column) * after_next(pair.offset) - after_next(column) * next(pair.offset);
  const Three<S> reach_a =
      next(pair.half_a) * after_next(size) + after_next(pair.half_a) * next(size);
  const Three<S> reach_b = spread<kNext>(pair.half_b) * absolute<S>(pair.columns.of[kAfter]) +
                           spread<kAfter>(pair.half_b) * absolute<S>(pair.columns.of[kNext]);
  const Three<S> gap = absolute<S>(offset) - (reach_a + reach_b);
  const Three<S> squares = column * column;
  const Three<S> sine = square_roots<S>(next(squares) + after_next(squares));
  const Three<S> over_sine = S(1) / sine;  // infinite if parallel
  return {offset, sine, over_sine, (gap - off) * over_sine,
          lanes::smaller<Three<S>>((gap + off) * over_sine, floor + sliver * sine)};
}

/// sat() for two boxes. Metres; `margin` >= 0.
///
/// Steps: 1. A's faces and 2. B's faces: each may separate. 3. The nine cross products: they may
/// separate too. If none can beat the best face, or only by less than the preference, the face
/// wins. 4. Otherwise one of them must beat all others by more than the error, and is measured.
template <class S>
[[gnu::always_inline]] inline BoxAxis<S> box_sat(const BoxPair<S>& pair, S margin,
                                                 Preference preference) {
  constexpr S kEpsilon = std::numeric_limits<S>::epsilon();
  const bool relative = preference == Preference::Relative;
  const S tie = relative ? tie_tolerance(pair.scale) : S(0);
  BoxAxis<S> result;
  const BestFace<S> face_a = query_faces_of_a(pair, tie);
  if (face_a.separation > margin + tie) {
    result.verdict = Verdict::Separated;
    return result;
  }
  const BestFace<S> face_b = query_faces_of_b(pair, tie);
  if (face_b.separation > margin + tie) {
    result.verdict = Verdict::Separated;
    return result;
  }
  const S floor = std::max(face_a.separation, face_b.separation);
  if (!(face_a.unique && face_b.unique && floor <= margin)) return result;
  // An edge pair must exceed this, as in sat().
  const S edge_floor = relative ? floor : floor + edge_handicap(pair.scale, preference);

  // About ten roundings here and ten in sat(), of products of lengths up to `scale`, with a
  // rotation whose columns are orthonormal within ten.
  const S off = S(32) * kEpsilon * pair.scale;
  const S sliver = floor <= S(0) ? S(2.1) * pair.scale : std::numeric_limits<S>::max();
  result.directions = pair.directions_of_b();
  const Crosses<S> nine[] = {crosses<0>(pair, result.directions, off, floor, sliver),
                             crosses<1>(pair, result.directions, off, floor, sliver),
                             crosses<2>(pair, result.directions, off, floor, sliver)};
  const S most_upper = largest_of<S>(nine[0].upper, nine[1].upper, nine[2].upper);
  const S spare = relative ? S(0.9) * preference_tolerance(floor, pair.min_radius) : S(0);
  S most = floor;  // largest of all axes
  bool has_edge = false;
  if (!(most_upper < edge_floor)) {
    const S most_lower = largest_of<S>(nine[0].lower, nine[1].lower, nine[2].lower);
    if (most_lower > margin + tie + (edge_floor - floor)) {
      result.verdict = Verdict::Separated;
      return result;
    }
    if (!(floor <= S(0) && most_upper <= margin)) return result;
    if (relative && most_upper < floor + spare) {
      most = most_upper + tie;
    } else {
      const S rival = most_lower - S(2) * tie;
      const std::uint32_t near =
          bits_of_nine<S>(nine[0].upper >= rival, nine[1].upper >= rival, nine[2].upper >= rival);
      const std::uint32_t best = bits_of_nine<S>(
          nine[0].lower == most_lower, nine[1].lower == most_lower, nine[2].lower == most_lower);
      if (near != best || (best & (best - 1)) != 0 || !(most_lower > edge_floor + tie))
        return result;
      const int bit = std::countr_zero(best | 0x1000U), i = bit & 3, j = bit >> 2;
      const S offset = nine[j].offset[i];
      if (!(nine[j].sine[i] > S(1.1) * kNoisySine<S> && std::abs(offset) > off)) return result;
      const int against = offset < S(0) ? 1 : 0;
      result.edges = edges_along(pair, i, j, against);
      result.edge =
          measure(pair, result.edges, i, j, against, result.directions.of[j], nine[j].over_sine[i]);
      if (!(result.edge.separation <= S(0))) return result;
      most = result.edge.separation;
      has_edge = true;
    }
  }

  // The same as choose() of sat.cpp. If the best axis is only bounded, both ends must agree.
  const auto choose = [&](S best) __attribute__((always_inline)) {
    const S least = best - (relative ? preference_tolerance(best, pair.min_radius) : S(0));
    if (face_a.separation >= least) return AxisKind::FaceA;
    return face_b.separation >= least ? AxisKind::FaceB : AxisKind::EdgeEdge;
  };
  const AxisKind chosen = choose(most);
  result.deepest = has_edge ? most : floor;
  if (!has_edge && chosen != choose(floor)) return result;
  if (chosen == AxisKind::EdgeEdge) {
    if (has_edge) result.verdict = Verdict::Edge;
    return result;
  }
  result.verdict = Verdict::Face;
  result.reference = chosen == AxisKind::FaceA ? Owner::A : Owner::B;
  const BestFace<S>& face = chosen == AxisKind::FaceA ? face_a : face_b;
  result.face.face = face.face;
  result.face.separation = face.separation;
  return result;
}

}  // namespace contactscope::boxes

#include "query/sat.h"

#include <algorithm>

#include "query/tolerance.h"

namespace contactscope {
namespace {

/// Talk: "the minimizing feature defines the contact type". Faces of the preferred hull before those
/// of the other before edges: strictly by depth without a preference, within its tolerance with it.
template <class S>
AxisKind choose(const SatResult<S>& queries, S tolerance, Owner preferred) {
  const S least = queries.separation(queries.deepest) - tolerance;
  const AxisKind first = preferred == Owner::A ? AxisKind::FaceA : AxisKind::FaceB;
  const AxisKind second = preferred == Owner::A ? AxisKind::FaceB : AxisKind::FaceA;
  if (queries.separation(first) >= least) return first;
  if (queries.separation(second) >= least) return second;
  return AxisKind::EdgeEdge;
}

}  // namespace

template <class S>
SatResult<S> sat(const HullPair<S>& pair, S margin, Preference preference,
                 FaceSeparations<S>& faces_a, FaceSeparations<S>& faces_b, Owner preferred) {
  SatResult<S> result;
  const S tie = preference == Preference::Relative ? tie_tolerance(pair.scale) : S(0);
  result.tie = tie;

  result.face_a = query_faces(pair.a, pair.b, tie, faces_a);
  result.queries_run = 1;
  result.chosen = result.deepest = AxisKind::FaceA;
  if (result.face_a.separation > margin) return result;  // we found a separating axis

  result.face_b = query_faces(pair.b, pair.a, tie, faces_b);
  result.queries_run = 2;
  result.chosen = result.deepest = AxisKind::FaceB;
  if (result.face_b.separation > margin) return result;  // we found a separating axis

  const S floor = std::max(result.face_a.separation, result.face_b.separation);
  result.edge = query_edges(pair, faces_a, floor, tie);
  result.queries_run = 3;
  result.chosen = result.deepest = AxisKind::EdgeEdge;
  const bool has_edge = result.edge.edge_a >= 0;
  if (has_edge && result.edge.separation > margin) return result;  // we found a separating axis

  if (pair.a.hull.flat() && pair.b.hull.flat()) [[unlikely]] {
    const EdgeQuery<S> side = query_sides(pair);
    if (side.separation > margin) {
      result.edge = side;
      return result;  // we found a separating axis
    }
  }

  // No separating axis: the hulls overlap, or are within the margin of each other.
  result.status = SatStatus::Touching;
  if (!has_edge || !(result.edge.separation > floor)) {
    const bool is_of_b = result.face_b.separation > result.face_a.separation;
    result.deepest = is_of_b ? AxisKind::FaceB : AxisKind::FaceA;
  }
  const S tolerance = preference == Preference::Relative
                          ? preference_tolerance(result.separation(result.deepest), pair.min_radius)
                          : S(0);
  result.chosen = choose(result, tolerance, preferred);
  return result;
}

template <class S>
SatResult<S> sat(const HullPair<S>& pair, S margin, Preference preference, Owner preferred) {
  FaceSeparations<S> faces_a(pair.a);
  FaceSeparations<S> faces_b(pair.b);
  return sat(pair, margin, preference, faces_a, faces_b, preferred);
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                 \
  template SatResult<S> sat(const HullPair<S>&, S, Preference, FaceSeparations<S>&, \
                            FaceSeparations<S>&, Owner);                            \
  template SatResult<S> sat(const HullPair<S>&, S, Preference, Owner);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope

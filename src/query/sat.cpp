#include "query/sat.h"

#include "query/fast/face_bounds.h"
#include "query/support_set.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// Talk: "the minimizing feature defines the contact type". Order: faces of the preferred hull, of
/// the other, edges; strictly by depth without a preference, otherwise within its tolerance.
template <class S> AxisKind choose(const SatResult<S>& queries, S tolerance, Owner preferred) {
  const S least = queries.separation(queries.deepest) - tolerance;
  const AxisKind first = preferred == Owner::A ? AxisKind::FaceA : AxisKind::FaceB;
  const AxisKind second = preferred == Owner::A ? AxisKind::FaceB : AxisKind::FaceA;
  if (queries.separation(first) >= least) return first;
  if (queries.separation(second) >= least) return second;
  return AxisKind::EdgeEdge;
}

template <class S> S tie_of(const HullPair<S>& pair, Preference preference) {
  return preference == Preference::Relative ? tie_tolerance(pair.scale) : S(0);
}

/// Stores the result of a face query of A or B. Returns true if it found a separating axis.
template <class S>
bool is_separated(SatResult<S>& result, AxisKind kind, const FaceQuery<S>& query, S margin) {
  (kind == AxisKind::FaceA ? result.face_a : result.face_b) = query;
  ++result.queries_run;
  result.chosen = result.deepest = kind;
  return query.separation > margin;
}

/// The same for the edge query, which may have found no pair.
template <class S> bool is_separated(SatResult<S>& result, const EdgeQuery<S>& query, S margin) {
  result.edge = query;
  ++result.queries_run;
  result.chosen = result.deepest = AxisKind::EdgeEdge;
  return query.edge_a >= 0 && query.separation > margin;
}

/// Separation that an edge pair must exceed.
template <class S>
S floor_of(const HullPair<S>& pair, Preference preference, const SatResult<S>& faces) {
  return std::max(faces.face_a.separation, faces.face_b.separation) +
         edge_handicap(pair.scale, preference);
}

/// No separating axis: the hulls overlap, or are within the margin of each other.
template <class S>
void touch(const HullPair<S>& pair, Preference preference, Owner preferred, SatResult<S>& result) {
  result.status = SatStatus::Touching;
  if (result.edge.edge_a < 0 || !(result.edge.separation > floor_of(pair, preference, result))) {
    const bool is_of_b = result.face_b.separation > result.face_a.separation;
    result.deepest = is_of_b ? AxisKind::FaceB : AxisKind::FaceA;
  }
  const S tolerance = preference == Preference::Relative
                          ? preference_tolerance(result.separation(result.deepest), pair.min_radius)
                          : S(0);
  result.chosen = choose(result, tolerance, preferred);
}

/// The vertex of B farthest towards A's centroid: only a starting point.
template <class S> int vertex_towards_a(const HullPair<S>& pair) {
  const Hull<S>& b = pair.b.hull;
  const Vec3<S> from_vertex = pair.a.hull.centroid - pair.b.vertices[0];
  const Vec3<S> in_b = pair.b.rotation.transpose() * from_vertex;
  return support_index(support_set(b), Vec3<S>(in_b + b.vertices[0] - b.centroid));
}

/// Starts B's faces with three corners of a face of A; no other vertex of A is beyond that face.
template <class S> void look_at_face(const Hull<S>& a, int face, FaceBounds<S>& faces_b) {
  const auto origin = [&](int edge) { return at(a.half_edges, edge).origin; };
  const int first = at(a.face_edges, face);
  const int second = at(a.half_edges, first).next;
  const int third = at(a.half_edges, second).next;
  faces_b.look_at({origin(first), origin(second), origin(third)});
}

/// Smaller hulls are measured completely in the time that the bounds take.
constexpr int kFewestVertices = 16;

/// sat() using bounds. Returns false if faces tie, or if measuring all of them takes no longer.
template <class S>
bool sat_by_bounds(const HullPair<S>& pair, S margin, Preference preference, Owner preferred,
                   SatResult<S>& result) {
  const int fewer = std::min(pair.a.hull.vertex_count(), pair.b.hull.vertex_count());
  if (fewer < kFewestVertices || pair.a.hull.flat() || pair.b.hull.flat()) return false;
  result.tie = tie_of(pair, preference);

  FaceBounds<S> faces_a(pair.a, pair.b);
  faces_a.look_at({vertex_towards_a(pair)});
  if (!faces_a.find_best(result.tie)) return false;
  if (is_separated(result, AxisKind::FaceA, faces_a.best(), margin)) return true;

  FaceBounds<S> faces_b(pair.b, pair.a);
  look_at_face(pair.a.hull, result.face_a.face, faces_b);
  if (!faces_b.find_best(result.tie)) return false;
  if (is_separated(result, AxisKind::FaceB, faces_b.best(), margin)) return true;

  if (!is_separated(result,
                    query_edges(pair, faces_a, floor_of(pair, preference, result), result.tie),
                    margin))
    touch(pair, preference, preferred, result);
  return true;
}

/// The inner loop runs over faces, which do not depend on each other and fill vector registers.
template <class S>
void measure(const PlacedHull<S>& reference, const PlacedHull<S>& other,
             FaceSeparations<S>& result) {
  const int faces = reference.normals.padded_count();
  const S* __restrict nx = reference.normals.x();
  const S* __restrict ny = reference.normals.y();
  const S* __restrict nz = reference.normals.z();
  const S* __restrict offset = reference.offsets;
  S* __restrict deepest = result.separations.data();
  S* __restrict support = result.supports.data();
  for (int f = 0; f < faces; ++f) {
    deepest[f] = std::numeric_limits<S>::infinity();
    support[f] = S(0);
  }
  for (int v = 0; v < other.vertices.count(); ++v) {
    const S x = other.vertices.x()[v], y = other.vertices.y()[v], z = other.vertices.z()[v];
    const S index = static_cast<S>(v);
    for (int f = 0; f < faces; ++f) {
      const S distance = dot(nx[f], ny[f], nz[f], x, y, z) - offset[f];
      support[f] = distance < deepest[f] ? index : support[f];
      deepest[f] = distance < deepest[f] ? distance : deepest[f];
    }
  }
}

}  // namespace

template <class S>
SatResult<S> sat(const HullPair<S>& pair, S margin, Preference preference,
                 FaceSeparations<S>& faces_a, FaceSeparations<S>& faces_b, Owner preferred) {
  SatResult<S> result;
  const S tie = result.tie = tie_of(pair, preference);
  const FaceQuery<S> face_a = query_faces(pair.a, pair.b, tie, faces_a);
  if (is_separated(result, AxisKind::FaceA, face_a, margin)) return result;
  const FaceQuery<S> face_b = query_faces(pair.b, pair.a, tie, faces_b);
  if (is_separated(result, AxisKind::FaceB, face_b, margin)) return result;
  const EdgeQuery<S> edge = query_edges(pair, faces_a, floor_of(pair, preference, result), tie);
  if (is_separated(result, edge, margin)) return result;

  if (pair.a.hull.flat() && pair.b.hull.flat()) [[unlikely]] {
    const EdgeQuery<S> side = query_sides(pair);
    if (side.separation > margin) {
      result.edge = side;
      return result;  // we found a separating axis
    }
  }
  touch(pair, preference, preferred, result);
  return result;
}

template <class S>
SatResult<S> sat(const HullPair<S>& pair, S margin, Preference preference, Owner preferred) {
  SatResult<S> result;
  if (sat_by_bounds(pair, margin, preference, preferred, result)) return result;
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

/// Gregorius 2015, QueryFaceDirections: for each face plane find the support point of the other
/// hull in the opposite direction; keep the largest distance.
template <class S>
FaceQuery<S> query_faces(const PlacedHull<S>& reference, const PlacedHull<S>& other, S tie,
                         FaceSeparations<S>& all) {
  measure(reference, other, all);
  FaceQuery<S> best{0, all.support(0), all.separation(0)};
  for (int f = 1; f < reference.normals.count(); ++f) {
    if (all.separation(f) > best.separation + tie) best = {f, all.support(f), all.separation(f)};
  }
  return best;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(query_faces);

}  // namespace contactscope

#pragma once

#include "core/manifold.h"
#include "query/hull_pair.h"

/// The separating axis test for two hulls. Source: Gregorius 2015, "Hull vs Hull: The Separating
/// Axis Test" and the following slides. Everything in A's frame, metres.
namespace contactscope {

/// Best face of one hull against the other. `separation` in metres: distance of the other hull's
/// support vertex from the face plane, negative in overlap.
template <class S> struct FaceQuery {
  int face = -1;
  int support = -1;  // vertex of the other hull that is deepest below the face
  S separation = 0;
};

/// Best edge pair that forms a face of the Minkowski difference.
template <class S> struct EdgeQuery {
  int edge_a = -1;  // half-edges; -1 if there is no such pair
  int edge_b = -1;
  S separation = 0;                   // metres, negative in overlap
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B, in A's frame
};

/// Support vertex of the other hull for every face, and its distance from the face, as lanes. The
/// index is stored as S, which is exact below 2^24, so that both fill the same vector registers.
template <class S> struct FaceSeparations {
  explicit FaceSeparations(const PlacedHull<S>& reference)
      : separations(reference.normals.padded_count()), supports(reference.normals.padded_count()) {}

  S separation(int face) const { return separations[face]; }
  int support(int face) const { return static_cast<int>(supports[face]); }

  Scratch<S, 128> separations;
  Scratch<S, 128> supports;
};

enum class SatStatus {
  Separated,  // `chosen` is the first query that found a separation > margin
  Touching,   // `chosen` is the axis that makes the contact
};

/// Result of the queries. They run in the order face A, face B, edges, and stop after the first
/// that separates; the results of skipped queries keep their initial values. The edge query only
/// finds pairs that beat both face queries by edge_handicap() (tolerance.h).
template <class S> struct SatResult {
  SatStatus status = SatStatus::Separated;
  AxisKind chosen = AxisKind::FaceA;   // see SatStatus
  AxisKind deepest = AxisKind::FaceA;  // the axis of largest separation, regardless of preferences
  int queries_run = 0;                 // 1 to 3
  S tie = 0;                           // metres; a pair must beat an earlier one by more
  FaceQuery<S> face_a;
  FaceQuery<S> face_b;
  EdgeQuery<S> edge;

  /// Metres, negative in overlap. `kind` must have run; an edge query without a pair has no value.
  S separation(AxisKind kind) const {
    if (kind == AxisKind::FaceA) return face_a.separation;
    return kind == AxisKind::FaceB ? face_b.separation : edge.separation;
  }
};

/// The face of `reference` with the largest separation from `other`; fills `all` with the values of
/// all faces. A face must beat an earlier one by more than `tie` (metres, >= 0) to replace it.
template <class S>
FaceQuery<S> query_faces(const PlacedHull<S>& reference, const PlacedHull<S>& other, S tie,
                         FaceSeparations<S>& all);

/// The edge pair with the largest separation above `floor` among those that form a face of the
/// Minkowski difference, or none. A pair must beat an earlier one by more than `tie` (metres, >=
/// 0). `faces_a` is the result of query_faces for A. Nearly parallel edges, whose cross product is
/// unreliable, are measured with support points (tolerance.h).
template <class S>
EdgeQuery<S> query_edges(const HullPair<S>& pair, const FaceSeparations<S>& faces_a, S floor,
                         S tie);

/// All edge pairs that form a face of the Minkowski difference, in the order of A's edges. Only for
/// pictures of the Gauss map; the pipeline does not need them.
template <class S>
std::vector<EdgeQuery<S>> all_crossings(const HullPair<S>& pair, const FaceSeparations<S>& faces_a);

/// For two flat hulls: the direction away from an edge, in the plane of its hull, with the largest
/// separation. If both are in one plane, all other axes are their common normal.
template <class S> EdgeQuery<S> query_sides(const HullPair<S>& pair);

/// Runs the queries and chooses the axis. The result is Separated if an axis separates the hulls by
/// more than `margin` (metres, >= 0). Among faces of nearly equal depth, those of `preferred` win.
///
/// For larger hulls, faces and edges that bounds prove worse than the best are skipped (see
/// face_bounds.h). This does not change a bit of the result.
template <class S>
SatResult<S> sat(const HullPair<S>& pair, S margin, Preference preference,
                 Owner preferred = Owner::A);

/// The same, but measures every face and returns the measurements of the face queries that ran.
template <class S>
SatResult<S> sat(const HullPair<S>& pair, S margin, Preference preference,
                 FaceSeparations<S>& faces_a, FaceSeparations<S>& faces_b,
                 Owner preferred = Owner::A);

/// Upper bound, metres, of the separation along all axes of the separating axis test except those
/// close to `normal` (unit, from A to B, A's frame): face normals n of either hull with n . normal
/// < `cosine`, and the parts of the arcs of A's edges on the Gauss map with the same condition,
/// whether or not an edge of B crosses them now. `cosine` is in (0, 1).
///
/// The result is at least `floor` (< 0): smaller values are not refined. It is +infinity if an arc
/// may contain a separating axis, or if the bound exceeds `ceiling`, which ends the search.
/// `faces_a` and `faces_b` are the results of the face queries.
template <class S>
S far_separation(const HullPair<S>& pair, const FaceSeparations<S>& faces_a,
                 const FaceSeparations<S>& faces_b, const Vec3<S>& normal, S cosine, S floor,
                 S ceiling = std::numeric_limits<S>::infinity());

}  // namespace contactscope

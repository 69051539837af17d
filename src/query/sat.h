#pragma once

#include <limits>
#include <vector>

#include "core/manifold.h"
#include "query/hull_pair.h"

/// The separating axis test between two hulls. Source: Gregorius 2015, "Hull vs Hull: The
/// Separating Axis Test" and the slides after it. Everything is in A's frame, metres.
namespace contactscope {

/// Best face of one hull against the other hull. Separation in metres: the distance of the other
/// hull's support vertex from the face plane, negative in overlap.
template <class S>
struct FaceQuery {
  int face = -1;
  int support = -1;  // vertex of the other hull, deepest below the face
  S separation = 0;
};

/// Best edge pair that forms a face of the Minkowski difference.
template <class S>
struct EdgeQuery {
  int edge_a = -1;  // half-edges; -1 when there is no such pair
  int edge_b = -1;
  S separation = 0;                   // metres, negative in overlap
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B, in A's frame
};

/// For every face of one hull the distance of the other hull's support vertex, and that vertex, as
/// lanes. The index is held in S, which holds every index below 2^24 exactly, so that both fill
/// the same vector registers.
template <class S>
struct FaceSeparations {
  explicit FaceSeparations(const PlacedHull<S>& reference)
      : separations(reference.normals.padded_count()), supports(reference.normals.padded_count()) {}

  S separation(int face) const { return separations[face]; }
  int support(int face) const { return static_cast<int>(supports[face]); }

  Scratch<S, 128> separations;
  Scratch<S, 128> supports;
};

enum class SatStatus {
  Separated,  // `chosen` names the first query that found a separation > margin
  Touching,   // `chosen` names the axis that makes the contact
};

/// What the queries found. Queries run in the order face A, face B, edges and stop at the first
/// whose best axis separates; the results of those that did not run keep their initial values. The
/// edge query looks only for what beats both face queries by edge_handicap() (tolerance.h).
template <class S>
struct SatResult {
  SatStatus status = SatStatus::Separated;
  AxisKind chosen = AxisKind::FaceA;   // see SatStatus
  AxisKind deepest = AxisKind::FaceA;  // the axis of largest separation, whatever is preferred
  int queries_run = 0;                 // 1 to 3
  S tie = 0;                           // metres: by this much a pair had to beat an earlier one
  FaceQuery<S> face_a;
  FaceQuery<S> face_b;
  EdgeQuery<S> edge;

  /// Metres, negative in overlap. `kind` must have run; an edge query without a pair has none.
  S separation(AxisKind kind) const {
    if (kind == AxisKind::FaceA) return face_a.separation;
    return kind == AxisKind::FaceB ? face_b.separation : edge.separation;
  }
};

/// The face of `reference` that is farthest from `other`; fills `all` with every face's. A face
/// must beat an earlier one by more than `tie` (metres, >= 0) to replace it.
template <class S>
FaceQuery<S> query_faces(const PlacedHull<S>& reference, const PlacedHull<S>& other, S tie,
                         FaceSeparations<S>& all);

/// The edge pair of largest separation among those that form a face of the Minkowski difference and
/// whose separation is larger than `floor`; none when there is no such pair. A pair must beat an
/// earlier one by more than `tie` (metres, >= 0) to replace it. `faces_a` is what query_faces found
/// for A. Nearly parallel edges, whose cross product says little, are measured with support points
/// (see tolerance.h).
template <class S>
EdgeQuery<S> query_edges(const HullPair<S>& pair, const FaceSeparations<S>& faces_a, S floor,
                         S tie);

/// Every edge pair that forms a face of the Minkowski difference, in the order of A's edges. The
/// pipeline has no need of them all: they are for pictures of the Gauss map.
template <class S>
std::vector<EdgeQuery<S>> all_crossings(const HullPair<S>& pair, const FaceSeparations<S>& faces_a);

/// Of two flat hulls: the direction in the plane of either, away from one of its edges, along which
/// they are farthest apart. Flat hulls side by side on one plane are separated by no other axis: their
/// faces say nothing, and all crosses of their edges are the faces' normal.
template <class S>
EdgeQuery<S> query_sides(const HullPair<S>& pair);

/// Runs the queries and chooses the axis. Separated when an axis is found along which the hulls are
/// more than `margin` (metres, >= 0) apart. Of faces that are nearly as deep those of `preferred`
/// come first.
///
/// Of larger hulls faces and edges are left out that bounds show to be worse than the best (see
/// face_bounds.h). That changes no bit of the result.
template <class S>
SatResult<S> sat(const HullPair<S>& pair, S margin, Preference preference,
                 Owner preferred = Owner::A);

/// The same by measuring every face, and leaves what the face queries that ran have measured.
template <class S>
SatResult<S> sat(const HullPair<S>& pair, S margin, Preference preference,
                 FaceSeparations<S>& faces_a, FaceSeparations<S>& faces_b,
                 Owner preferred = Owner::A);

/// An upper bound, metres, of the separation along every axis of the separating axis test that
/// points elsewhere than `normal` (unit, from A to B, A's frame): face normals n of either hull with
/// n . normal < `cosine`, and the parts of the arcs of A's edges on the Gauss map for which that
/// holds, whether or not an edge of B crosses them now. `cosine` is in (0, 1).
///
/// Never less than `floor` (< 0), which saves looking closer at what lies below. +infinity where an
/// arc may hold an axis that separates, and where the bound would be above `ceiling`, which ends the
/// search. `faces_a` and `faces_b` are what the face queries found.
template <class S>
S far_separation(const HullPair<S>& pair, const FaceSeparations<S>& faces_a,
                 const FaceSeparations<S>& faces_b, const Vec3<S>& normal, S cosine, S floor,
                 S ceiling = std::numeric_limits<S>::infinity());

}  // namespace contactscope

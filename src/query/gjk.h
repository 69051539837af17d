#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/pose.h"
#include "core/static_vector.h"
#include "query/support_set.h"

namespace contactscope {

enum class GjkStatus {
  Separated,        // a distance > 0 and the closest points were found
  Touching,         // the origin is on the border of the difference within rounding
  Overlap,          // the origin is inside of the difference by more than rounding: in the last
                    // simplex, a tetrahedron, or on a lesser one that itself lies inside
  OutOfIterations,  // kMaxGjkIterations; the result is an upper bound of the distance. Not seen
};

/// "separated", "touching", "overlap", "out_of_iterations".
constexpr const char* to_string(GjkStatus status) {
  constexpr const char* kNames[] = {"separated", "touching", "overlap", "out_of_iterations"};
  return kNames[static_cast<int>(status)];
}

/// A point of the Minkowski difference B - A, by the points that it is the difference of.
template <class S>
struct GjkVertex {
  int index_a, index_b;  // in the support sets
  Vec3<S> a, b;          // both in A's frame
};

/// Which features are closest follows from the indices: of A a vertex where all index_a are equal,
/// an edge where there are two of them, a face where there are three; of B likewise.
template <class S>
struct GjkSimplex {
  StaticVector<GjkVertex<S>, 4> vertices;
  std::array<S, 4> weights;  // barycentric, of the point nearest to the origin; positive, sum 1
};

template <class S>
struct GjkResult {
  GjkStatus status = GjkStatus::OutOfIterations;
  S distance = 0;                     // metres; 0 in overlap
  Vec3<S> on_a, on_b;                 // closest points in A's frame; in overlap a common point
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B, in A's frame; of meaning if Separated
  int iterations = 0;                 // support points looked for
  GjkSimplex<S> simplex;              // the last
};

/// Far more than any pair takes: all but three steps bring the simplex strictly nearer, and ten
/// thousand random pairs, needles and plates among them, took less than forty.
inline constexpr int kMaxGjkIterations = 256;

/// Record of a run of GJK.
template <class S>
struct GjkRun {
  GjkResult<S> result;
  std::vector<GjkSimplex<S>> steps;  // one an iteration; empty when GJK was not needed
};

/// Distance and closest points of two convex cores. Metres; all results in A's frame. `warm_start`
/// is the simplex of an earlier call for the same two sets, or nullptr; it changes how many
/// iterations are taken, and the result by rounding only. `run`: record of this run, null when nobody
/// watches.
///
/// The distance is right to a few ulps of the pair's length scale, the sum of both reaches and the
/// way between the frames; shapes nearer than that are Touching. The normal keeps the shapes apart
/// by the distance up to the same rounding. Swapping A and B changes rounding only. Flat,
/// needle-like, coincident and coplanar points are fine, as are lengths from 1e-18 m to 1e18 m.
template <class S>
GjkResult<S> gjk(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                 const GjkSimplex<S>* warm_start = nullptr, GjkRun<S>* run = nullptr);

}  // namespace contactscope

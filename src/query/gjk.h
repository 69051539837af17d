#pragma once

#include "core/static_vector.h"
#include "query/support_set.h"

namespace contactscope {

enum class GjkStatus {
  Separated,        // distance > 0; the closest points were found
  Touching,         // the origin is on the boundary of the difference within rounding
  Overlap,          // the origin is inside the difference by more than rounding: in the last
                    // simplex, a tetrahedron, or on a lower one that is itself inside
  OutOfIterations,  // kMaxGjkIterations; the distance is an upper bound. Never observed
};

constexpr const char* to_string(GjkStatus status) {
  constexpr const char* kNames[] = {"separated", "touching", "overlap", "out_of_iterations"};
  return kNames[static_cast<int>(status)];
}

/// A vertex of the Minkowski difference B - A, with the two points that it is the difference of.
template <class S> struct GjkVertex {
  int index_a, index_b;  // indices into the support sets
  Vec3<S> a, b;          // both in A's frame
};

/// Closest features: one distinct index_a is a vertex of A, two are an edge, three a face; also B.
template <class S> struct GjkSimplex {
  StaticVector<GjkVertex<S>, 4> vertices;
  std::array<S, 4> weights;  // barycentric, of the point closest to the origin; positive, sum 1
};

template <class S> struct GjkResult {
  GjkStatus status = GjkStatus::OutOfIterations;
  S distance = 0;                     // metres; 0 in overlap
  Vec3<S> on_a, on_b;                 // closest points in A's frame; in overlap a common point
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B, in A's frame; valid if Separated
  int iterations = 0;                 // number of support points computed
  GjkSimplex<S> simplex;              // final simplex
};

/// Far more than any pair needs: all but three steps bring the simplex strictly closer, and ten
/// thousand random pairs, including needles and plates, took less than forty.
inline constexpr int kMaxGjkIterations = 256;

template <class S> struct GjkRun {
  GjkResult<S> result;
  std::vector<GjkSimplex<S>> steps;  // one per iteration; empty if GJK was not needed
};

/// Distance and closest points of two convex cores. Metres; all results in A's frame. `warm_start`
/// is the simplex of an earlier call for the same two sets, or null; it affects the number of
/// iterations, and the result only by rounding. `run`: record of this run, or null.
///
/// The distance is correct to a few ulps of the pair's length scale: the sum of both reaches and
/// the distance between the frames. Shapes closer than that are Touching. The normal separates the
/// shapes by the distance up to the same rounding. Swapping A and B changes only rounding. Flat,
/// needle-like, coincident and coplanar points are supported, and lengths from 1e-18 m to 1e18 m.
template <class S>
GjkResult<S> gjk(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                 const GjkSimplex<S>* warm_start = nullptr, GjkRun<S>* run = nullptr);

// simplex.cpp

/// The point of a simplex closest to the origin, and the face of the simplex that contains it.
template <class S> struct NearestOnSimplex {
  int count;                 // 1: vertex, 2: edge, 3: triangle, 4: the origin is inside
  std::array<int, 4> kept;   // first `count` entries: indices of simplex points, ascending
  std::array<S, 4> weights;  // first `count` entries: barycentric, positive, sum 1
  Vec3<S> point;             // zero if the origin is inside
  S squared_distance;
  /// From the origin towards the simplex, any length: `point`, or a triangle's normal where that is
  /// more accurate, because near the origin `point` is all rounding.
  Vec3<S> direction;
};

/// Considers only the faces that contain the last point, because GJK adds a point that brings the
/// simplex closer. `points` are `count` points, 1 to 4, possibly coincident, collinear or coplanar.
/// `scale` bounds the terms that they were differences of: rounding is relative to it. Its fourth
/// power, also times eps^2, must be in the range of S.
template <class S>
void nearest_on_simplex(const std::array<Vec3<S>, 4>& points, int count, S scale,
                        NearestOnSimplex<S>& result);

}  // namespace contactscope

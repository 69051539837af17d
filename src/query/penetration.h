#pragma once

#include <array>
#include <vector>

#include "core/manifold.h"
#include "query/gjk.h"
#include "query/support_set.h"

/// How deep two convex cores are in each other: the least way along which moving B parts them, and
/// the direction of it. Gregorius 2015, "Building Incremental Manifolds (1)", names four ways. All
/// work on support points in A's frame, metres, and give the same result.
///
/// In terms of the Minkowski difference B - A: the cores overlap where it holds the origin, and the
/// depth is the origin's distance from its surface. **Any** unit direction n gives an upper bound,
/// max over A of n . a less min over B of n . b, for moving B by that along n parts the cores; every
/// method's `depth` is such a value, measured with support points, so that a normal which is not
/// the best one is still one that works.
namespace contactscope {

enum class PenetrationStatus {
  Converged,        // the method's own measure of the end was met: `depth` is what it finds
  Flat,             // the difference has no volume within rounding: depth 0 across it
  Separated,        // a direction parts the cores by more than rounding: no depth
  Stalled,          // rounding leaves no way on, and bounds are apart; `depth` is an upper bound
  OutOfIterations,  // options.max_iterations; `depth` is an upper bound
  NotFinite,        // a coordinate is not a number or infinite: nothing is said
};

/// "converged", "flat", "separated", "stalled", "out_of_iterations", "not_finite".
const char* to_string(PenetrationStatus status);

/// Whether depth, normal and points are of meaning.
constexpr bool has_depth(PenetrationStatus status) {
  return status != PenetrationStatus::Separated && status != PenetrationStatus::NotFinite;
}

template <class S>
struct PenetrationOptions {
  /// Depths this near, as a fraction of the pair's length scale (see gjk.h), count as equal; less
  /// than rounding allows counts as that.
  S tolerance = 0;
  /// At most this many steps; 0 or more than the method's own cap: that cap.
  int max_iterations = 0;
  /// Of sampling: directions before the search about the best, at least 6, at most 2^20.
  int samples = 256;
};

template <class S>
struct PenetrationResult {
  PenetrationStatus status = PenetrationStatus::NotFinite;
  S depth = 0;                        // metres, >= 0, along `normal`; a bound from above
  S least_depth = 0;                  // metres: a bound from below where the method knows one, or 0
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B, in A's frame
  /// Deepest points of A and B, in A's frame: (on_a - on_b) . normal = depth, up to the tolerance.
  /// Of Sat and Epa they are also one above the other along the normal, where they converged.
  Vec3<S> on_a = Vec3<S>::Zero(), on_b = Vec3<S>::Zero();
  int iterations = 0;
};

/// The polytope of EPA before one expansion.
template <class S>
struct PolytopeStep {
  std::vector<GjkVertex<S>> vertices;
  std::vector<std::array<int, 3>> faces;  // counter-clockwise seen from outside
  int nearest = -1;                       // face to expand
  S distance = 0;                         // metres, of it from the origin
};

template <class S>
struct DirectionStep {
  Vec3<S> normal;  // unit, from A to B, in A's frame
  S separation;    // metres along it, negative in overlap
};

/// What a run did, for somebody who watches; a method fills its own list.
template <class S>
struct PenetrationSteps {
  std::vector<PolytopeStep<S>> polytopes;
  std::vector<std::array<GjkVertex<S>, 4>> portals;  // inner point (indices -1), then the portal
  std::vector<DirectionStep<S>> directions;
};

/// Whether cores may overlap after GJK: they touch or overlap, or are apart by so little that
/// rounding may have put them there. Seen in single precision between hulls of 8 vertices: 4 ulps of
/// the pair's scale apart by GJK, 32 deep by the separating axis test in double.
template <class S>
bool may_overlap(const GjkResult<S>& gjk, const SupportSet<S>& a, const SupportSet<S>& b,
                 const Pose<S>& b_in_a);

/// Runs one of the methods. `overlap` is the simplex of a GJK run on the same sets after which they
/// may_overlap(), or nullptr; EPA starts from it, and without it runs GJK first. `steps`
/// may be nullptr; it changes no bit of the result.
///
/// Degenerate input: NaN or infinity gives NotFinite; cores that touch give depth 0 within rounding;
/// differences without volume (a point in a face's plane is none, two segments are) give Flat.
template <class S>
PenetrationResult<S> penetration(PenetrationMethod method, const SupportSet<S>& a,
                                 const SupportSet<S>& b, const Pose<S>& b_in_a,
                                 const PenetrationOptions<S>& options = {},
                                 const GjkSimplex<S>* overlap = nullptr,
                                 PenetrationSteps<S>* steps = nullptr);

}  // namespace contactscope

#pragma once

#include "core/manifold.h"
#include "query/gjk.h"

/// Penetration depth of two convex cores: length and direction of the shortest translation of B
/// that separates them. Four methods, listed in Gregorius 2015, "Building Incremental Manifolds
/// (1)". All use support points in A's frame, metres, and return the same type of result.
///
/// In terms of the Minkowski difference B - A: the cores overlap if it contains the origin, and the
/// depth is the origin's distance from its surface. **Any** unit direction n gives an upper bound,
/// max over A of n . a minus min over B of n . b, because moving B by that along n separates the
/// cores. Every method measures its `depth` so, and a suboptimal normal is still valid.
namespace contactscope {

enum class PenetrationStatus {
  Converged,        // the method's own criterion was met: `depth` is its result
  Flat,             // the difference has no volume within rounding: depth 0 across it
  Separated,        // a direction separates the cores by more than rounding: no depth
  Stalled,          // rounding stops progress before the bounds meet; `depth` is an upper bound
  OutOfIterations,  // options.max_iterations; `depth` is an upper bound
  NotFinite,        // a coordinate is NaN or infinite: no result
};

const char* to_string(PenetrationStatus status);

/// True if depth, normal and points are valid.
constexpr bool has_depth(PenetrationStatus status) {
  return status != PenetrationStatus::Separated && status != PenetrationStatus::NotFinite;
}

template <class S> struct PenetrationOptions {
  /// Depths within this fraction of the pair's length scale count as equal; at least rounding.
  S tolerance = 0;
  /// Maximum number of steps; 0, or more than the method's own limit: that limit.
  int max_iterations = 0;
  /// Sampling only: number of directions before the local search, at least 6, at most 2^20.
  int samples = 256;
};

template <class S> struct PenetrationResult {
  PenetrationStatus status = PenetrationStatus::NotFinite;
  S depth = 0;                        // metres, >= 0, along `normal`; an upper bound
  S least_depth = 0;                  // metres; a lower bound if the method has one, or 0
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B, in A's frame
  /// Deepest points of A and B, in A's frame: (on_a - on_b) . normal = depth, up to the tolerance.
  /// For converged Sat and Epa, on_a - on_b is also parallel to the normal.
  Vec3<S> on_a = Vec3<S>::Zero(), on_b = Vec3<S>::Zero();
  int iterations = 0;
};

/// The polytope of EPA before an expansion.
template <class S> struct PolytopeStep {
  std::vector<GjkVertex<S>> vertices;
  std::vector<std::array<int, 3>> faces;  // counter-clockwise seen from outside
  int nearest = -1;                       // face to expand
  S distance = 0;                         // metres, from the origin to that face
};

template <class S> struct DirectionStep {
  Vec3<S> normal;  // unit, from A to B, in A's frame
  S separation;    // metres along it, negative in overlap
};

/// Record of a run; each method fills its own list.
template <class S> struct PenetrationSteps {
  std::vector<PolytopeStep<S>> polytopes;
  std::vector<std::array<GjkVertex<S>, 4>> portals;  // inner point (indices -1), then the portal
  std::vector<DirectionStep<S>> directions;
};

/// True if cores may overlap after GJK: they touch or overlap, or the distance could be rounding
/// alone. Observed in single precision for hulls of 8 vertices: GJK separates by 4 ulps of the
/// pair's scale, but the separating axis test in double finds a depth of 32 ulps.
template <class S>
bool may_overlap(const GjkResult<S>& gjk, const SupportSet<S>& a, const SupportSet<S>& b,
                 const Pose<S>& b_in_a);

/// Runs a method. `overlap`: the simplex of a GJK run on the same sets after which they
/// may_overlap(), from which EPA starts, or null. `steps`: a record or null, without effect.
///
/// Degenerate input: NaN or infinity gives NotFinite. Touching cores give depth 0 within rounding.
/// Differences without volume give Flat: two segments, for example.
template <class S>
PenetrationResult<S> penetration(PenetrationMethod method, const SupportSet<S>& a,
                                 const SupportSet<S>& b, const Pose<S>& b_in_a,
                                 const PenetrationOptions<S>& options = {},
                                 const GjkSimplex<S>* overlap = nullptr,
                                 PenetrationSteps<S>* steps = nullptr);

}  // namespace contactscope

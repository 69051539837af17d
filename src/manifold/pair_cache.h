#pragma once

#include "manifold/collide_options.h"
#include "manifold/contact.h"
#include "query/sat.h"

/// Temporal coherence. Source: Gregorius 2015, "Hull vs Hull: Temporal Coherence". The last
/// separating axis is tried first. If the hulls overlapped, the contact is rebuilt from the last
/// features, and the separating axis test runs only if this fails.
///
/// **A hit guarantees what a full test guarantees.** Separated means separated along the kept axis,
/// measured at the new pose with the support points of both hulls. A touching pair gets the
/// manifold of the kept features at the new pose; in overlap it is bit for bit the full test's
/// manifold for these features. The preference accepts this axis: its separation s is not below
/// best - preference_tolerance(best), where `best` is the largest of all axes, and the deepest
/// point is deep enough as in create_contact.h. So results with a cache equal those without, up to
/// the preference. Preference::None leaves no room for that, so it keeps only separating axes.
///
/// **Proof.** Let n be a unit direction from A to B and sep(n) = min over B of n . b - max over A
/// of n . a.
///
/// 1. Any point q of B and p of A bound it: sep(n) <= n . (q - p).
/// 2. Let q be the deepest point of the new manifold, s_q below the reference face, and p its foot
///    there. Then q - p = s_q n_c, and sep(n) <= s_q cos(n, n_c) for *every* n, s_q < 0. So axes
///    near the kept one are no better than s_q times the cosine of the angle to it: among those
///    within 18 degrees it is deeper than the best by no more than 5%.
/// 3. If no point of B, seen from A, has moved by more than m, no sep(n) has grown by more than m;
///    likewise for normals of B, seen from B. So axes far from the kept one are no better than m
///    plus the largest that they were, or could have been, at the full test: far_separation().
///
///                 far     . '    ' .     far       near axes are bounded by what is seen now,
///                       .'  near   '.              far axes by what was seen at the full test
///              ---------.-----^-----.--------      and by how far the pair has moved since
///                         n_c |
///
/// best is no larger than the larger of the two bounds. The kept axis is accepted if s is within
/// the preference of that. So a pair's allowed motion depends on how much worse its other axes are,
/// not on the preference: some 20% of their radius for boxes at rest on a face; next to nothing for
/// a box that touches at a corner of the Minkowski difference, where two axes are equally deep.
///
/// A hit does not change the cache, so bounds do not add up over frames.
namespace contactscope {

template <class S> class Recorder;

enum class CachedKind : std::uint8_t { Empty, SeparatingAxis, Features };

constexpr const char* to_string(CachedKind kind) {
  if (kind == CachedKind::Empty) return "empty";
  return kind == CachedKind::SeparatingAxis ? "separating_axis" : "features";
}

/// Result of the last full test of one pair of hulls; keep one per pair. Use it for the same two
/// hulls in the same order; only their poses may change. Other hulls count as an empty cache where
/// the difference shows, and otherwise affect only the result.
template <class S> struct PairCache {
  CachedKind kind = CachedKind::Empty;
  AxisKind axis = AxisKind::FaceA;
  int first = -1;                     // face of the axis's hull, or half-edge of A
  int second = -1;                    // half-edge of B; unused for a face axis
  S radius_a = 0, radius_b = 0;       // of the hulls at the full test
  Vec3<S> normal = Vec3<S>::UnitX();  // of the axis at the full test, from A to B, in A's frame

  // Bounds for the other axes, at the full test. These and all members below are set for features.
  Quat<S> rotation = Quat<S>::Identity();  // of b_in_a
  Vec3<S> center_b = Vec3<S>::Zero();      // B's centroid in A's frame
  Vec3<S> center_a = Vec3<S>::Zero();      // A's centroid in B's frame
  S near_cosine = 1;                       // axes at a larger angle are far
  S far = 0;                               // metres: largest separation of a far axis
  S best = 0;                              // metres: largest separation of any axis

  // For a face axis: results to reuse until another candidate can have overtaken them.
  int support = -1;          // vertex of the other hull, deepest below the face
  S support_clearance = 0;   // metres: how much deeper it is than the next vertex
  int incident = -1;         // face around it, most anti-parallel
  S incident_clearance = 0;  // how much lower its cosine is than the next face's
};

template <class S> struct CacheAnswer {
  bool hit = false;
  CachedKind kind = CachedKind::Empty;  // the kind that was tried
  AxisKind axis = AxisKind::FaceA;      // the axis that was tried
  Vec3<S> normal = Vec3<S>::UnitX();    // of a hit: its axis, unit, from A to B, in A's frame
  S separation = 0;                     // metres, along the kept axis
  S moved = 0;                          // for features: m above, metres
};

/// Tries `cache`. On a hit `contact` is the pair's, in A's frame, empty when separated; otherwise
/// `contact` is undefined. A pose that is not finite is never a hit.
template <class S>
CacheAnswer<S> collide_from_cache(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                                  const CollideOptions& options, const PairCache<S>& cache,
                                  Contact<S>& contact, Recorder<S>* recorder);

/// Cache of a full test with these results; `faces_a`, `faces_b`: from its face queries.
template <class S>
PairCache<S> cache_of(const HullPair<S>& pair, const Pose<S>& b_in_a, const CollideOptions& options,
                      const SatResult<S>& axes, const FaceSeparations<S>& faces_a,
                      const FaceSeparations<S>& faces_b, const Contact<S>& contact);

}  // namespace contactscope

#pragma once

#include <cstdint>

#include "core/manifold.h"
#include "core/pose.h"
#include "manifold/collide_options.h"
#include "manifold/contact.h"
#include "query/sat.h"

/// Temporal coherence. Source: Gregorius 2015, "Hull vs Hull: Temporal Coherence": the last
/// separating axis is tried first; where hulls overlapped, the contact is built from the last
/// features again, and the separating axis test runs only if this fails.
///
/// **What a hit promises** is what a full test promises. Separated means separated along the kept
/// axis, measured at the new pose with the support points of both hulls. A touching pair gets the
/// manifold that the kept features make at the new pose, in overlap bit for bit what the full test
/// would make of them, and this axis is one that the preference accepts: its separation s is not below
/// best - preference_tolerance(best), where `best` is the largest of all axes, and the deepest point
/// is deep enough as create_contact.h has it. So results with a cache are those without, up to the
/// preference. With Preference::None that leaves no room, and only separating axes are kept.
///
/// **Why that holds.** Let n be a unit direction from A to B and sep(n) = min over B of n . b - max
/// over A of n . a.
///
/// 1. Any point q of B and p of A bound it: sep(n) <= n . (q - p).
/// 2. Of the new manifold take the deepest point: q lies s_q below the reference face and p is its
///    foot there, so q - p = s_q n_c, and sep(n) <= s_q cos(n, n_c) for *every* n, s_q < 0. Axes
///    near the kept one are thus no better than s_q times the cosine of the angle to it: among
///    those within 18 degrees it is deeper than the best by no more than 5%.
/// 3. Where no point of B, seen from A, has moved by more than m, no sep(n) has grown by more than
///    m; the same for normals of B, seen from B. Axes far from the kept one are thus no better than
///    m plus the largest that they were, or could have been, at the full test: far_separation().
///
///                 far     . '    ' .     far       near axes are bounded by what is seen now,
///                       .'  near   '.              far axes by what was seen at the full test
///              ---------.-----^-----.--------      and by how far the pair has moved since
///                         n_c |
///
/// best is no larger than the larger of both bounds; the kept axis is accepted when s is within the
/// preference of that. How far a pair may move so depends on how much worse its other axes are, not
/// on the preference: boxes at rest on a face some 20% of their radius, a box that touches at a
/// corner of the Minkowski difference, where two axes are equally deep, next to nothing.
///
/// A hit leaves the cache as it is: bounds do not add up over frames.
namespace contactscope {

template <class S>
class Recorder;

enum class CachedKind : std::uint8_t { Empty, SeparatingAxis, Features };

/// "separating_axis", "features", as traces spell it.
constexpr const char* to_string(CachedKind kind) {
  if (kind == CachedKind::Empty) return "empty";
  return kind == CachedKind::SeparatingAxis ? "separating_axis" : "features";
}

/// What the last full test of one pair of hulls decided; keep one for each pair. Meant for the same
/// two hulls in the same order, whose poses change. Others are taken for an empty cache where they
/// can be told apart, and do no harm to anything but the result where they cannot.
template <class S>
struct PairCache {
  CachedKind kind = CachedKind::Empty;
  AxisKind axis = AxisKind::FaceA;
  int first = -1;                     // face of the axis's hull, or half-edge of A
  int second = -1;                    // half-edge of B; not read for a face axis
  S radius_a = 0, radius_b = 0;       // of the hulls that it belongs to
  Vec3<S> normal = Vec3<S>::UnitX();  // of the axis at the full test, from A to B, in A's frame

  // What bounds the other axes, at the full test; set for features, as all that follows.
  Quat<S> rotation = Quat<S>::Identity();  // b_in_a's
  Vec3<S> center_b = Vec3<S>::Zero();      // B's centroid in A's frame
  Vec3<S> center_a = Vec3<S>::Zero();      // A's centroid in B's frame
  S near_cosine = 1;                       // axes at a larger angle are far
  S far = 0;                               // metres: no far axis had a larger separation

  // Of a face axis: what need not be looked for again for as long as no other can have overtaken.
  int support = -1;          // vertex of the other hull, deepest below the face
  S support_clearance = 0;   // metres: so much deeper than its next
  int incident = -1;         // face around it, most anti-parallel
  S incident_clearance = 0;  // its cosine is so much less than its next's
};

/// What the cache gave.
template <class S>
struct CacheAnswer {
  bool hit = false;
  CachedKind kind = CachedKind::Empty;  // what was tried, or what a hit used
  AxisKind axis = AxisKind::FaceA;      // that was tried
  Vec3<S> normal = Vec3<S>::UnitX();    // of a hit: its axis, unit, from A to B, in A's frame
  S separation = 0;                     // metres, along the kept axis
  S moved = 0;                          // of features: m above, metres
};

/// Tries what `cache` holds. On a hit `contact` is the pair's, in A's frame, empty when separated;
/// else nothing can be said of `contact`. A pose that is not finite is never a hit.
template <class S>
CacheAnswer<S> collide_from_cache(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                                  const CollideOptions& options, const PairCache<S>& cache,
                                  Contact<S>& contact, Recorder<S>* recorder);

/// What is to be kept of a full test: `axes` and `contact` are its results, `faces_a` and `faces_b`
/// what its face queries measured.
template <class S>
PairCache<S> cache_of(const HullPair<S>& pair, const Pose<S>& b_in_a, const CollideOptions& options,
                      const SatResult<S>& axes, const FaceSeparations<S>& faces_a,
                      const FaceSeparations<S>& faces_b, const Contact<S>& contact);

}  // namespace contactscope

#pragma once

#include "manifold/pair_cache.h"
#include "query/tolerance.h"

/// Which clipped points make a contact, and if they are as deep as the overlap. Metres.
namespace contactscope {

/// Clipping keeps points up to this separation. It allows for rounding: otherwise all four corners
/// of a face exactly at the margin could be dropped.
template <class S> S highest_kept(S margin, S scale) { return margin + depth_rounding(scale); }

/// Whether a manifold whose deepest point has separation `deepest` is as deep as the hulls overlap.
/// `best` (<= 0) is the largest separation of any axis. A preference may cost at most 5% of the
/// depth, however shallow: a solver does not push back what it does not see.
template <class S> bool is_deep_enough(S deepest, S best, Preference preference, S scale) {
  const S part = preference == Preference::Relative ? S(0.95) : S(1);
  return deepest <= part * best + depth_rounding(scale);
}

/// The difference of two rotations by an angle t moves no unit vector farther than 2 sin(t / 2), at
/// most twice the distance of their quaternions with the signs that bring them nearest.
template <class S> S turn_since(const PairCache<S>& cache, const Quat<S>& rotation) {
  const S gap = (rotation.coeffs() - cache.rotation.coeffs()).squaredNorm();
  const S opposite = (rotation.coeffs() + cache.rotation.coeffs()).squaredNorm();
  return S(2) * std::sqrt(std::min(gap, opposite));
}

/// Whether the preference accepts this separation of an axis, if no axis has more than `bound`.
template <class S> bool preferred(S separation, S bound, S margin, S min_radius) {
  const S tolerance = preference_tolerance(std::min(bound, S(0)), min_radius);
  return bound <= margin && bound - separation <= tolerance;
}

/// Whether points whose deepest has this separation are deep enough, whichever axis is now best.
/// That axis is no deeper than the kept one, of this `separation`, nor than the best one of the
/// full test can have become: no separation falls by more than the pair has `moved`. If that is not
/// enough, `along_face()` measures the incident face and `along_edges()` the edges that cross at
/// the deepest point: where the side planes cut off the support vertex, one of them is the best.
template <class S, class AlongFace, class AlongEdges>
bool is_still_deep(const PairCache<S>& cache, S deepest, S separation, S moved, S scale,
                   const AlongFace& along_face, const AlongEdges& along_edges) {
  const auto deep_for = [&](S best) {
    return best > S(0) || is_deep_enough(deepest, best, Preference::Relative, scale);
  };
  return deep_for(std::max(separation, cache.best - moved)) || deep_for(along_face()) ||
         deep_for(along_edges());
}

/// The edges of A and B that cross at the first deepest point; -1 if two edges of one hull do.
template <class Points> std::pair<int, int> edges_at_deepest(const Points& points) {
  const auto& deepest = *std::min_element(
      points.begin(), points.end(),
      [](const auto& one, const auto& two) { return one.separation < two.separation; });
  const auto& [first, second] = deepest.id;
  if (first.kind != FeatureKind::Edge || second.kind != FeatureKind::Edge ||
      first.owner == second.owner)
    return {-1, -1};
  return {static_cast<int>(first.index), static_cast<int>(second.index)};
}

}  // namespace contactscope

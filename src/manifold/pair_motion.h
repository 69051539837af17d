#pragma once

#include <algorithm>
#include <cmath>

#include "manifold/contact_depth.h"
#include "manifold/pair_cache.h"
#include "query/tolerance.h"

/// What both go by that try a PairCache, any two hulls and two boxes: how far a pair has turned since the
/// full test, and whether the kept axis is still preferred.
namespace contactscope {

/// The difference of two rotations by an angle t apart takes no unit vector farther than 2 sin(t /
/// 2), which is at most twice the distance of their quaternions, 2 sin(t / 4), taken with the signs
/// that bring them nearest.
template <class S>
S turn_since(const PairCache<S>& cache, const Quat<S>& rotation) {
  const S apart = (rotation.coeffs() - cache.rotation.coeffs()).squaredNorm();
  const S opposite = (rotation.coeffs() + cache.rotation.coeffs()).squaredNorm();
  return S(2) * std::sqrt(std::min(apart, opposite));
}

/// Whether the preference takes an axis of this separation where no axis has more than `bound`, and
/// the margin leaves the pair touching.
template <class S>
bool preferred(S separation, S bound, S margin, S min_radius) {
  const S tolerance = preference_tolerance(std::min(bound, S(0)), min_radius);
  return bound <= margin && bound - separation <= tolerance;
}

/// Whether points whose deepest one has this separation are deep enough, whichever axis the best is
/// now: it is no deeper than the kept one.
template <class S>
bool is_still_deep(S deepest, S separation, S scale) {
  return separation > S(0) || is_deep_enough(deepest, separation, Preference::Relative, scale);
}

}  // namespace contactscope

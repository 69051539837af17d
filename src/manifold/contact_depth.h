#pragma once

#include "core/manifold.h"
#include "query/tolerance.h"

/// Which clipped points make a contact, and whether they are as deep as the hulls overlap. Metres;
/// `scale` is the pair's, see HullPair.
namespace contactscope {

/// Clipping keeps points up to this separation. It allows for rounding: otherwise all four corners
/// of a face exactly at the margin could be dropped.
template <class S>
S highest_kept(S margin, S scale) {
  return margin + depth_rounding(scale);
}

/// Whether a manifold whose deepest point has separation `deepest` is as deep as the hulls overlap.
/// `best` (<= 0) is the largest separation of any axis. A preference may cost at most 5% of the
/// depth, however shallow: a solver does not push back what it does not see.
template <class S>
bool is_deep_enough(S deepest, S best, Preference preference, S scale) {
  const S part = preference == Preference::Relative ? S(0.95) : S(1);
  return deepest <= part * best + depth_rounding(scale);
}

}  // namespace contactscope

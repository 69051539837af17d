#pragma once

#include "core/manifold.h"
#include "query/tolerance.h"

/// Which clipped points make a contact, and whether they are as deep as the hulls overlap. Metres;
/// `scale` is the pair's, see HullPair.
namespace contactscope {

/// Clipping keeps points up to this separation for a margin. Hulls whose axis is at the margin have
/// their points there as well, but for rounding: without it all four corners of a face that kisses
/// another could be dropped.
template <class S>
S highest_kept(S margin, S scale) {
  return margin + depth_rounding(scale);
}

/// Whether a manifold whose deepest point has the separation `deepest` is as deep as the hulls
/// overlap; `best` (<= 0) is the largest separation of any axis. A preference may cost 5% of the
/// depth but no more, however shallow that is: what a solver is not shown it does not push back.
template <class S>
bool is_deep_enough(S deepest, S best, Preference preference, S scale) {
  const S part = preference == Preference::Relative ? S(0.95) : S(1);
  return deepest <= part * best + depth_rounding(scale);
}

}  // namespace contactscope

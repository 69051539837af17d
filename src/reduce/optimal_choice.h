#pragma once

#include <span>

#include "reduce/optimal_ring.h"
#include "reduce/reducer.h"

namespace contactscope {

/// The ring of at most `most` >= 2 corners of a patch that keeps the most: the largest one, or the
/// two extremes when most is 2 or the patch is flat, or one corner when all coincide.
template <class S>
CornerRing<S> largest_ring(const Patch<S>& patch, int most);

/// The points of a ring, counter-clockwise seen against the normal, beginning with the deepest.
template <class S>
KeptIndices kept_points(ContactPoints<S> points, const Patch<S>& patch, const CornerRing<S>& ring);

/// A choice of points that contains one given point.
template <class S>
struct ChoiceWith {
  CornerRing<S> ring;  // its doubled area is that of the hull of all kept
  bool is_in_ring;     // else the given point is kept beside the ring
};

/// The choice of at most `most` >= 1 points that contains `point` and keeps the most. When another
/// point at the same place is a corner of the patch, `point` takes its part.
template <class S>
ChoiceWith<S> largest_with(ContactPoints<S> points, Patch<S>& patch, int point, int most);

/// The points of such a choice, `point` first.
template <class S>
KeptIndices kept_points(ContactPoints<S> points, const Patch<S>& patch, const ChoiceWith<S>& choice,
                        int point);

}  // namespace contactscope

#pragma once

#include <limits>

#include "geometry/hull.h"
#include "geometry/lanes.h"
#include "query/scratch.h"

namespace contactscope {

/// The largest of `count` values, a multiple of the lane width.
template <class S>
inline S largest_in_lanes(const S* __restrict values, int count) {
  S best[kLaneWidth];
  for (int k = 0; k < kLaneWidth; ++k) best[k] = -std::numeric_limits<S>::infinity();
  for (int i = 0; i < count; i += kLaneWidth) {
    for (int k = 0; k < kLaneWidth; ++k) {
      best[k] = values[i + k] > best[k] ? values[i + k] : best[k];
    }
  }
  S largest = best[0];
  for (int k = 1; k < kLaneWidth; ++k) largest = best[k] > largest ? best[k] : largest;
  return largest;
}

/// Signed distances of a point from the planes of all faces of a hull, in the hull's frame, metres:
/// the separating axis test of a point, for which faces are the only axes (Gregorius 2015, "Sphere
/// vs Hull: Deep Penetration").
template <class S>
class PointFaces {
 public:
  PointFaces(const Hull<S>& hull, const Vec3<S>& point);

  S operator[](int face) const { return distances_[face]; }
  /// The largest. Negative: the point is inside, and this far from the surface.
  S largest() const { return largest_; }

  /// The earliest face whose distance is within `tie` (metres, >= 0) of the largest; of several,
  /// the earliest that the point projects into.
  int nearest(S tie) const;
  /// Whether a face within `tie` of the largest leans away from `face` by more than the sine
  /// `direction` says: then which of them is nearest is up to rounding, and it matters.
  bool is_tied(int face, S tie, S sine) const;

 private:
  const Hull<S>& hull_;
  Vec3<S> point_;
  S largest_;
  Scratch<S, 128> distances_;
};

}  // namespace contactscope

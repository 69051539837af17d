#pragma once

#include "geometry/hull.h"
#include "query/scratch.h"

namespace contactscope {

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

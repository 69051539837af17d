#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/pack.h"
#include "geometry/hull.h"
#include "geometry/lanes.h"
#include "query/scratch.h"

namespace contactscope {

/// The largest of `count` values, a multiple of the lane width.
template <class S>
inline S largest_in_lanes(const S* values, int count) {
  lanes::Pack<S> best = lanes::all(-std::numeric_limits<S>::infinity());
  for (int i = 0; i < count; i += lanes::kWidth<S>) {
    best = lanes::larger(lanes::load(values + i), best);
  }
  return lanes::largest<S>(best)[0];
}

/// Calls visit(i) for each of `count` values that is not less than `least`, in order. The values are
/// padded to the lane width, with anything.
template <class S, class Visit>
inline void for_each_not_below(const S* values, int count, S least, const Visit& visit) {
  constexpr int kLanes = lanes::kWidth<S>;
  const lanes::Pack<S> bound = lanes::all(least);
  for (int i = 0; i < count; i += kLanes) {
    std::uint32_t found = ~lanes::bits<S>(lanes::load(values + i) < bound) & ((1U << kLanes) - 1);
    for (; found != 0; found &= found - 1) {
      const int at = i + std::countr_zero(found);
      if (at < count) visit(at);
    }
  }
}

/// Calls visit(i) for each of `count` values that has all of `bits`, in order. The values are padded
/// to the lane width, with anything.
template <class Visit>
inline void for_each_with_bits(const int* values, int count, int bits, const Visit& visit) {
  using Ints = lanes::Flags<float>;
  const Ints wanted = {bits, bits, bits, bits};
  for (int i = 0; i < count; i += 4) {
    Ints four;
    std::memcpy(&four, values + i, sizeof four);
    std::uint32_t found = lanes::bits<float>((four & wanted) == wanted);
    for (; found != 0; found &= found - 1) {
      const int at = i + std::countr_zero(found);
      if (at < count) visit(at);
    }
  }
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

#pragma once

#include <vector>

#include "core/vec3.h"

namespace contactscope {

/// Loops over lanes run to a multiple of this, so that the compiler needs no remainder loop.
inline constexpr int kLaneWidth = 4;

constexpr int padded(int count) {
  return (count + kLaneWidth - 1) / kLaneWidth * kLaneWidth;
}

/// Vectors as a structure of arrays that stands elsewhere: all x, then all y, then all z, each
/// padded to the lane width. What the padding holds is up to who fills it.
template <class S>
class VectorLanes {
 public:
  /// `values` holds 3 * padded(count) elements and outlives this.
  VectorLanes(const S* values, int count)
      : values_(values), count_(count), stride_(padded(count)) {}

  int count() const { return count_; }
  /// A multiple of the lane width, and known to be one, so that loops need no remainder.
  int padded_count() const { return stride_ & ~(kLaneWidth - 1); }
  const S* x() const { return values_; }
  const S* y() const { return values_ + stride_; }
  const S* z() const { return values_ + 2 * stride_; }

  Vec3<S> operator[](int i) const { return {x()[i], y()[i], z()[i]}; }

 private:
  const S* values_;
  int count_;
  int stride_;
};

/// n . p with the one order of additions that all queries use, so that a distance found in a loop
/// over lanes is found again, bit for bit, one element at a time.
template <class S>
inline S dot(S nx, S ny, S nz, S px, S py, S pz) {
  return (nx * px + ny * py) + nz * pz;
}

}  // namespace contactscope

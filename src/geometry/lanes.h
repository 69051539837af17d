#pragma once

#include "core/vec3.h"

namespace contactscope {

/// Loops over lanes run to a multiple of this, so the compiler needs no remainder loop.
inline constexpr int kLaneWidth = 4;

constexpr int padded(int count) { return (count + kLaneWidth - 1) / kLaneWidth * kLaneWidth; }

/// View of vectors stored as a structure of arrays: all x, then all y, then all z, each padded to
/// the lane width. The owner chooses the padding values.
template <class S> class VectorLanes {
 public:
  /// `values` holds 3 * padded(count) elements and must outlive this.
  VectorLanes(const S* values, int count)
      : values_(values), count_(count), stride_(padded(count)) {}

  int count() const { return count_; }
  /// The mask lets the compiler see a multiple of the lane width, so loops need no remainder.
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

/// n . p with the order of additions of all queries: loops over lanes give the same bits.
template <class S> inline S dot(S nx, S ny, S nz, S px, S py, S pz) {
  return (nx * px + ny * py) + nz * pz;
}

}  // namespace contactscope

#pragma once

#include <cstddef>
#include <memory>

#include "core/vec3.h"

namespace contactscope {

/// Loops over lanes run to a multiple of this, so that the compiler needs no remainder loop.
inline constexpr int kLaneWidth = 4;

constexpr int padded(int count) {
  return (count + kLaneWidth - 1) / kLaneWidth * kLaneWidth;
}

/// Scratch array of a size known at run time: on the stack up to `Inline` elements, beyond that on
/// the heap. Elements start uninitialised.
template <class T, int Inline>
class Scratch {
 public:
  explicit Scratch(int count) {
    if (count > Inline)
      heap_ = std::make_unique_for_overwrite<T[]>(static_cast<std::size_t>(count));
    data_ = count > Inline ? heap_.get() : inline_;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](int i) { return data_[i]; }
  const T& operator[](int i) const { return data_[i]; }

 private:
  T* data_;
  std::unique_ptr<T[]> heap_;
  alignas(16) T inline_[static_cast<std::size_t>(Inline)];
};

/// Vectors as a structure of arrays: all x, then all y, then all z, each padded to the lane width.
/// What the padding holds is up to who fills it.
template <class S, int Inline>
class VectorLanes {
  static_assert(Inline % kLaneWidth == 0);

 public:
  explicit VectorLanes(int count)
      : count_(count), stride_(padded(count)), values_(3 * padded(count)) {}

  int count() const { return count_; }
  /// A multiple of the lane width, and known to be one, so that loops need no remainder.
  int padded_count() const { return stride_ & ~(kLaneWidth - 1); }
  const S* x() const { return &values_[0]; }
  const S* y() const { return &values_[stride_]; }
  const S* z() const { return &values_[2 * stride_]; }
  S* x() { return &values_[0]; }
  S* y() { return &values_[stride_]; }
  S* z() { return &values_[2 * stride_]; }

  Vec3<S> operator[](int i) const { return {x()[i], y()[i], z()[i]}; }
  void set(int i, const Vec3<S>& v) {
    x()[i] = v.x();
    y()[i] = v.y();
    z()[i] = v.z();
  }
  void fill_padding(const Vec3<S>& v) {
    for (int i = count_; i < stride_; ++i) set(i, v);
  }

 private:
  int count_;
  int stride_;
  Scratch<S, 3 * Inline> values_;
};

/// n . p with the one order of additions that all queries use, so that a distance found in a loop
/// over lanes is found again, bit for bit, one element at a time.
template <class S>
inline S dot(S nx, S ny, S nz, S px, S py, S pz) {
  return (nx * px + ny * py) + nz * pz;
}

}  // namespace contactscope

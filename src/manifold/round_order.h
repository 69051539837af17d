#pragma once

#include <algorithm>

#include "core/pack.h"
#include "core/pose.h"
#include "geometry/shape.h"

/// Two spheres, or two capsules, are processed in an order of their own, so that swapping the
/// arguments mirrors the result: the larger radius first, then by their other numbers.
namespace contactscope {

/// Lexicographic comparison of two vectors: less (-1), equal (0) or more (1).
template <class V> int order_of(const V& one, const V& other) {
  for (int i = 0; i < static_cast<int>(one.size()); ++i) {
    if (one[i] != other[i]) return one[i] < other[i] ? -1 : 1;
  }
  return 0;
}

template <class S> int order_of(const Sphere<S>& a, const Sphere<S>& b) {
  if (a.radius != b.radius) return a.radius < b.radius ? -1 : 1;
  return 0;
}
template <class S> int order_of(const Capsule<S>& a, const Capsule<S>& b) {
  // Capsules of one scene usually have the same seven numbers: compared a pack at a time.
  constexpr int kNumbers = 7, kWidth = lanes::kWidth<S>;
  static_assert(sizeof(Capsule<S>) == kNumbers * sizeof(S));
  const S *const of_a = a.points[0].data(), *const of_b = b.points[0].data();
  lanes::Flags<S> differ = {};
  for (int i = 0; i < kNumbers; i += kWidth) {
    const int first = std::min(i, kNumbers - kWidth);
    differ |= lanes::load<S>(of_a + first) != lanes::load<S>(of_b + first);
  }
  if (lanes::bits<S>(differ) == 0) return 0;
  if (a.radius != b.radius) return a.radius < b.radius ? -1 : 1;
  const int order = order_of(a.points[0], b.points[0]);
  return order != 0 ? order : order_of(a.points[1], b.points[1]);
}
template <class S> int order_of(const Pose<S>& a, const Pose<S>& b) {
  if (a.rotation.w() != b.rotation.w()) return a.rotation.w() < b.rotation.w() ? -1 : 1;
  if (const int order = order_of(a.rotation.vec(), b.rotation.vec())) return order;
  return order_of(a.position, b.position);
}

/// Whether B comes first. `b_first` decides for pairs that are equal in everything.
template <class S, class Round>
bool against_order(const Round& a, const Pose<S>& pose_a, const Round& b, const Pose<S>& pose_b,
                   bool b_first) {
  int order = order_of(a, b);
  if (order == 0) order = order_of(pose_a, pose_b);
  return order < 0 || (order == 0 && b_first);
}

}  // namespace contactscope

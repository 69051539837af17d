#pragma once

#include <vector>

#include "core/pose.h"
#include "geometry/hull.h"
#include "support/random_geometry.h"

namespace contactscope::test {

/// Two hulls placed in the world.
template <class S> struct PairCase {
  Hull<S> a;
  Pose<S> pose_a;
  Hull<S> b;
  Pose<S> pose_b;

  template <class T> PairCase<T> cast() const {
    return {hull_cast<T>(a), pose_a.template cast<T>(), hull_cast<T>(b), pose_b.template cast<T>()};
  }
};

/// The length that rounding is relative to: both hulls with their frames, plus their offset.
template <class S> double length_scale(const PairCase<S>& pair) {
  return static_cast<double>(pair.a.centroid.norm() + pair.a.radius + pair.b.centroid.norm() +
                             pair.b.radius + (pair.pose_b.position - pair.pose_a.position).norm());
}

/// Boxes and hulls of up to 64 vertices, sizes over four decades, aspect up to 100, at a random
/// pose. They are far from each other, barely touch, overlap a little or deeply.
PairCase<double> random_pair(Random& random);

/// The same for bodies as engines expect them: 0.2 to 1 m, aspect up to 4.
PairCase<double> everyday_pair(Random& random);

/// Moves the whole pair; the relative pose stays.
template <class S> PairCase<S> moved(const PairCase<S>& pair, const Pose<S>& by) {
  PairCase<S> result{pair.a, compose(by, pair.pose_a), pair.b, compose(by, pair.pose_b)};
  result.pose_a.rotation.normalize();
  result.pose_b.rotation.normalize();
  return result;
}

template <class S> PairCase<S> swapped(const PairCase<S>& pair) {
  return {pair.b, pair.pose_b, pair.a, pair.pose_a};
}

}  // namespace contactscope::test

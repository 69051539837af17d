#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/standard.h"

#ifdef EIGEN_VECTORIZE_NEON
// Eigen sums three floats as a + (b + c), but as (a + b) + c where it has packets of two, which
// rounds differently. Skip those packets, so that arm64 gives the bits of other processors.
template <> struct Eigen::internal::find_best_packet<float, 3> {
  using type = Eigen::internal::Packet4f;
};
template <> struct Eigen::internal::find_best_packet<float, 9> {
  using type = Eigen::internal::Packet4f;
};
#endif

namespace contactscope {

/// Column vector of three, with Eigen's algebra. Functions take and return these, no expressions.
template <class S> using Vec3 = Eigen::Matrix<S, 3, 1>;

/// 3x3 matrix, columns are the images of the axes.
template <class S> using Mat3 = Eigen::Matrix<S, 3, 3>;

/// Unit quaternion; unaligned: one code path in all builds, and containers without an allocator.
template <class S> using Quat = Eigen::Quaternion<S, Eigen::DontAlign>;

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;
using Quatd = Quat<double>;

/// A unit vector perpendicular to `v`, |v| > 0. Depends continuously on `v` except where the helper
/// axis switches, which is the coordinate axis most perpendicular to `v`.
template <class S> Vec3<S> any_perpendicular(const Vec3<S>& v) {
  int axis = 0;
  v.cwiseAbs().minCoeff(&axis);
  const Vec3<S> perpendicular = v.cross(Vec3<S>::Unit(axis));
  return perpendicular.normalized();
}

}  // namespace contactscope

/// Instantiates one to five function templates, each for float and for double. Each name must have
/// a single template and its first parameter must be the scalar.
#define CONTACTSCOPE_FLOAT_AND_DOUBLE(...) \
  CONTACTSCOPE_RESCAN(CONTACTSCOPE_RESCAN( \
      CONTACTSCOPE_RESCAN(CONTACTSCOPE_RESCAN(CONTACTSCOPE_FIRST_NAME(__VA_ARGS__)))))

// A macro does not expand itself, so that each further name needs one more scan.
#define CONTACTSCOPE_RESCAN(...) __VA_ARGS__
#define CONTACTSCOPE_NOTHING
#define CONTACTSCOPE_NEXT_NAME() CONTACTSCOPE_FIRST_NAME
#define CONTACTSCOPE_FIRST_NAME(function, ...)                     \
  template decltype(function<float>) function<float>;              \
  template decltype(function<double>) function<double> __VA_OPT__( \
      ; CONTACTSCOPE_NEXT_NAME CONTACTSCOPE_NOTHING()(__VA_ARGS__))

#pragma once

#include "core/vec3.h"

/// Closest points of points and segments, the cores of spheres and capsules. All arguments in one
/// frame, metres. A segment may have length zero. Single precision allows lengths from 1e-6 m to
/// 1e9 m; beyond, fourth powers of lengths leave the range of float.
namespace contactscope {

template <class S> struct ClosestOnSegment {
  Vec3<S> point;
  S parameter;  // 0 at `from`, 1 at `to`; 0 on a segment of length zero
};

/// The point of the segment closest to `point`. The ends are exact.
template <class S>
ClosestOnSegment<S> closest_on_segment(const Vec3<S>& point, const Vec3<S>& from,
                                       const Vec3<S>& to);

template <class S> struct ClosestOfSegments {
  Vec3<S> on_a, on_b;
  S parameter_a, parameter_b;  // 0 at `from`, 1 at `to`; arbitrary on a segment of length zero
  S distance;                  // |on_b - on_a|; 0 up to rounding where segments cross
};

/// Closest points of two segments. The distance is correct to a few ulps of the largest difference
/// of coordinates. Swapping A and B swaps the result, bit for bit. For parallel segments that run
/// side by side, the middle of the common stretch.
template <class S>
ClosestOfSegments<S> closest_of_segments(const Vec3<S>& from_a, const Vec3<S>& to_a,
                                         const Vec3<S>& from_b, const Vec3<S>& to_b);

}  // namespace contactscope

#pragma once

#include "core/vec3.h"

/// Closest points of points and segments: the cores of spheres and capsules. All arguments in one
/// frame, metres. A segment may have length zero. Lengths from 1e-6 m to 1e9 m in single precision;
/// outside of that fourth powers of lengths leave the range of float.
namespace contactscope {

template <class S>
struct ClosestOnSegment {
  Vec3<S> point;
  S parameter;  // 0 at `from`, 1 at `to`; 0 on a segment of length zero
};

/// The point of the segment nearest to `point`. Ends are met exactly.
template <class S>
ClosestOnSegment<S> closest_on_segment(const Vec3<S>& point, const Vec3<S>& from,
                                       const Vec3<S>& to);

template <class S>
struct ClosestOfSegments {
  Vec3<S> on_a, on_b;
  S parameter_a, parameter_b;  // 0 at `from`, 1 at `to`; any on a segment of length zero
  S distance;                  // |on_b - on_a|; 0 where segments cross, up to rounding
};

/// The points of two segments nearest to each other; their distance is right to a few ulps of the
/// largest difference of coordinates. Swapping A and B swaps the result and changes no bit of it.
/// Where parallel segments lie beside each other, the middle of the stretch in which they do.
template <class S>
ClosestOfSegments<S> closest_of_segments(const Vec3<S>& from_a, const Vec3<S>& to_a,
                                         const Vec3<S>& from_b, const Vec3<S>& to_b);

}  // namespace contactscope

#pragma once

#include <array>

#include "continuous/swept_sphere.h"
#include "geometry/obb.h"

namespace contactscope {

struct SweptHit {
  SweptStatus status = SweptStatus::Separated;
  double time = 1;                // fraction of the step; 0 when Overlapping
  Vec3d normal = Vec3d::UnitX();  // unit, from the triangle to the shape; of a Hit
};

/// When a capsule that goes straight on, and does not turn, first meets a triangle that stands still.
/// `ends` are those of its segment at time 0, `displacement` its way in the step, metres, all in one
/// frame. Exact to rounding, as sweep_sphere_triangle() is, by which it is done: what a ball at the one
/// end must not meet is the triangle swept along the segment, a prism of two triangles and three
/// parallelograms, of which those that the ball cannot meet first are left out. Flat triangles and
/// segments of no length are fine.
template <class S>
SweptHit sweep_capsule_triangle(const std::array<Vec3<S>, 2>& ends, const Vec3<S>& displacement,
                                S radius, const std::array<Vec3<S>, 3>& triangle);

/// The same for a box, given at time 0. On each of the thirteen axes that can separate a box from a
/// triangle they overlap from one time to another; they meet at the last of the first times, if none of
/// them has parted by then. That is exact for shapes that do not turn, and no slower than one test of
/// overlap: no search is as good. In double, relative to a corner of the triangle.
/// Source: Ericson 2005, section 5.5.3, says intervals of overlap on axes for what moves.
template <class S>
SweptHit sweep_box_triangle(const Obb<S>& box, const Vec3<S>& displacement,
                            const std::array<Vec3<S>, 3>& triangle);

}  // namespace contactscope

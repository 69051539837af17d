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

/// First impact of a capsule, which moves but does not turn, with a triangle at rest. `ends`: of
/// its segment at time 0; `displacement`: in the step, metres, all in one frame. Exact to rounding,
/// by sweep_sphere_triangle(): a ball at one end against the triangle swept along the segment, a
/// prism of two triangles and three parallelograms. Faces that the ball cannot meet first are
/// skipped. Flat triangles and segments of zero length are fine.
template <class S>
SweptHit sweep_capsule_triangle(const std::array<Vec3<S>, 2>& ends, const Vec3<S>& displacement,
                                S radius, const std::array<Vec3<S>, 3>& triangle);

/// The same for a box, given at time 0. On each of the thirteen axes that can separate a box from a
/// triangle, they overlap for an interval of time. They meet at the latest begin, unless an
/// interval has ended by then. Exact for shapes that do not turn, and as fast as one overlap test.
/// Computed in double, relative to a corner of the triangle.
/// Source: Ericson 2005, section 5.5.3, intervals of overlap on axes for moving shapes.
template <class S>
SweptHit sweep_box_triangle(const Obb<S>& box, const Vec3<S>& displacement,
                            const std::array<Vec3<S>, 3>& triangle);

}  // namespace contactscope

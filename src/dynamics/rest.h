#pragma once

#include <span>
#include <string>

#include "core/vec3.h"
#include "trace/trace.h"

/// Gregorius 2015, "Incremental Manifold Stability": a body can rest on a manifold if its centre of
/// mass projects into it along the normal.
namespace contactscope {

/// Whether a body rests on a manifold's `points` with this `normal` (unit). World, metres. The
/// contact plane passes through the middle of the points, perpendicular to the normal. `rounding`,
/// metres: error of the points, see rounding_of(). A projection closer to the border is not inside,
/// and points closer to a line have no area. The verdict:
///   - "stable": the projection is inside, by more than rounding;
///   - "turns about a line": two points, points on a line, or the projection on or beyond an edge;
///   - "turns about a point": one point, or the projection beyond a corner;
///   - "no contact": no points. There is no plane, and projection and margin are meaningless.
trace::Stability rest_of(std::span<const Vec3d> points, const Vec3d& normal,
                         const Vec3d& center_of_mass, double rounding);

/// Bound of the pipeline's rounding for points with such coordinates. `epsilon`: of its scalar.
double rounding_of(std::span<const Vec3d> points, const Vec3d& center_of_mass, double epsilon);

/// The same for the manifolds of a recorded pair. A mesh's manifolds are joined: all points count,
/// and the normal is the mean over them. `shape`: name of the body.
trace::Stability rest_of(const trace::Pair& pair, const std::string& shape,
                         const Vec3d& center_of_mass, double epsilon);

}  // namespace contactscope

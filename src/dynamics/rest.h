#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/vec3.h"
#include "trace/trace.h"

/// Gregorius 2015, "Incremental Manifold Stability": a body can rest on a manifold if its centre of
/// mass projects inside of it, along the normal.
namespace contactscope {

/// Whether a body rests on a manifold's `points` with this `normal` (unit). World, metres. The contact
/// plane is that through the middle of the points across the normal. `rounding`, metres: how far
/// the points may be off, as rounding_of() says; no nearer to the border is inside, nor are points
/// nearer to a line than an area. The verdict:
///   - "stable": the projection is inside, by more than rounding;
///   - "turns about a line": two points, points on a line, or the projection on or beyond an edge;
///   - "turns about a point": one point, or the projection beyond a corner;
///   - "no contact": no points. There is no plane then: projection and margin say nothing.
trace::Stability rest_of(std::span<const Vec3d> points, const Vec3d& normal,
                         const Vec3d& center_of_mass, double rounding);

/// How far the pipeline's rounding may have moved points of such coordinates. `epsilon`: of its
/// scalar.
double rounding_of(std::span<const Vec3d> points, const Vec3d& center_of_mass, double epsilon);

/// The same of a recorded pair's manifolds, for the record. Of several manifolds, a mesh's, all
/// points count, and the normal is the mean of their points'. `shape` names the body.
trace::Stability rest_of(const trace::Pair& pair, const std::string& shape,
                         const Vec3d& center_of_mass, double epsilon);

}  // namespace contactscope

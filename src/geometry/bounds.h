#pragma once

#include <optional>
#include <span>

#include "geometry/bounding_sphere.h"
#include "geometry/obb.h"
#include "geometry/shape.h"

/// Bounding volumes of shapes. None is smaller than its shape: extents and radii are computed in
/// extended precision and rounded up, so that every vertex is inside as the numbers are, but for
/// 2^-60 of the size. A plane has no end, and so no bounds: nothing.
namespace contactscope {

/// Of a shape placed in the parent of `pose`: of its vertices as they are rounded there. Exact for
/// what stands still at the origin.
template <class S>
std::optional<Aabb<S>> aabb_of(const Shape<S>& shape, const Pose<S>& pose = {});

/// In the shape's own frame; `placed` moves it.
///
/// Of a sphere along the axes of its frame; of a capsule along its segment. Of a hull or a mesh the
/// one of the smallest surface of those tried, because that is what the chance of meeting a box grows
/// with, and it tells flat boxes apart: along the axes of the frame; along the principal axes of the
/// surface (Gottschalk, Lin and Manocha 1996); and of a hull, about the normal of each face and, up
/// to 64 edges, the cross product of each two edges, along each side of the outline that is seen
/// along it. The smallest box of all may lie otherwise (O'Rourke 1985). The own axes win ties, so
/// that the box of a box is itself, exactly.
template <class S>
std::optional<Obb<S>> obb_of(const Shape<S>& shape);

/// In the shape's own frame; `placed` moves it. The smallest there is, but for rounding, of a hull
/// or a mesh by pivoting: the farthest vertex joins the ball of at most four that were found
/// before, and of these five the smallest ball is the next (Gaertner 1999, "Fast and Robust
/// Smallest Enclosing Balls").
template <class S>
std::optional<BoundingSphere<S>> bounding_sphere_of(const Shape<S>& shape);

/// The smallest ball around points, metres; an empty one around none.
template <class S>
BoundingSphere<S> sphere_around(std::span<const Vec3<S>> points);

}  // namespace contactscope

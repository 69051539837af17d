#pragma once

#include "geometry/obb.h"
#include "geometry/shape.h"

/// Bounding volumes of shapes, computed in extended precision and rounded up: every vertex is
/// inside up to 2^-60 of the size. A plane is infinite and has no bounds: nullopt.
namespace contactscope {

/// Box of the shape in the parent of `pose`, around its vertices as rounded there.
template <class S> std::optional<Aabb<S>> aabb_of(const Shape<S>& shape, const Pose<S>& pose = {});

/// Oriented box in the shape's own frame; `placed` moves it.
///
/// A sphere's box follows the axes of its frame, a capsule's its segment. For hulls and meshes the
/// candidate with the smallest surface is taken: it is the chance of hitting it. Candidates: the
/// axes of the frame; the principal axes of the surface (Gottschalk, Lin and Manocha 1996); and for
/// hulls, around each face normal and (up to 64 edges) each cross product of two edges, the sides
/// of the outline seen from there. This is not always the smallest box (O'Rourke 1985). The own
/// axes win ties, so a box is its own bounding box, exactly.
template <class S> std::optional<Obb<S>> obb_of(const Shape<S>& shape);

/// Bounding sphere in the shape's own frame; `placed` moves it. For hulls and meshes the smallest
/// one up to rounding, by pivoting: the farthest vertex joins the at most four support points, and
/// so on (Gaertner 1999, "Fast and Robust Smallest Enclosing Balls").
template <class S> std::optional<BoundingSphere<S>> bounding_sphere_of(const Shape<S>& shape);

/// The smallest ball around points, metres; empty if there are none.
template <class S> BoundingSphere<S> sphere_around(std::span<const Vec3<S>> points);

}  // namespace contactscope

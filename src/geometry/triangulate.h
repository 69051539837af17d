#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vec3.h"
#include "geometry/hull.h"

namespace contactscope {

/// Cuts a polygon, convex or not, into corners.size() - 2 triangles that run around the same way:
/// indices into `corners`, of which there are at least three. The polygon should be nearly flat and
/// not cross itself; what does not keep to that still gets that many triangles, which may overlap.
/// Corners that lie on a line give no triangle of zero area as long as another cut is left. Depends
/// on nothing but the shape: not on place or scale. O(n^2).
///
/// Source: ear clipping, Meisters 1975, "Polygons have ears".
std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Vec3d> corners);

/// The same solid with every face cut into triangles: what a hull is whose coplanar faces nobody
/// merged. (Quickhull merges all the same while it grows, because the planes of slivers say nothing.)
/// Vertices, centroid and radius stay; triangles follow each other in the order of the
/// faces that they come from. Each keeps the plane of its face, so that the triangles of one face
/// tie exactly and a sliver is not tilted by its rounding. All other promises of Hull hold, but one:
/// an edge inside a face joins two faces with one plane.
///
/// A face stays whole where cutting it would join two vertices that have an edge already. That takes
/// faces that overlap within the hull builder's tolerance, or a hull without volume.
///
/// Clipping then sees only a part of the incident face, and is cut by a part of the reference face:
/// Gregorius 2015, "Hull vs Hull: Coplanar Faces".
Hull<double> triangulate_faces(const Hull<double>& hull);

}  // namespace contactscope

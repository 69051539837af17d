#pragma once

#include "geometry/hull.h"

namespace contactscope {

/// Cuts a polygon, convex or not, into corners.size() - 2 triangles with the same winding: indices
/// into `corners`. At least three corners, nearly flat and not crossing; otherwise triangles may
/// overlap. Collinear corners give no triangle of zero area as long as another cut exists. O(n^2).
///
/// Source: ear clipping, Meisters 1975, "Polygons have ears".
std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Vec3d> corners);

/// The same solid with every face cut into triangles, like a hull whose coplanar faces were never
/// merged. (Quickhull must merge while it grows, because the planes of slivers are unreliable.)
/// Vertices, centroid and radius stay; triangles are in the order of their faces. Each keeps the
/// plane of its face, so that triangles of one face tie exactly and rounding does not tilt slivers.
/// All invariants of Hull hold but one: an edge inside a face joins two faces with one plane.
///
/// A face stays whole if a cut would duplicate an existing edge. That happens only for faces that
/// overlap within the hull builder's tolerance, or for a hull without volume.
///
/// Clipping then uses only parts of the faces: Gregorius 2015, "Hull vs Hull: Coplanar Faces".
Hull<double> triangulate_faces(const Hull<double>& hull);

}  // namespace contactscope

#pragma once

#include "geometry/hull.h"

namespace contactscope {

/// The same solid with every face cut into triangles: what a hull is whose coplanar faces nobody
/// merged. Vertices, centroid and radius stay; triangles follow each other in the order of the
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

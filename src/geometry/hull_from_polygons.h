#pragma once

#include <vector>

#include "core/vec3.h"
#include "geometry/hull.h"
#include "geometry/shape_error.h"

namespace contactscope {

/// Half-edge hull from the polygons that bound it: `faces` are vertex indices, counter-clockwise
/// seen from outside. Vertices and faces keep their order, face_edges[f] leaves faces[f][0], and
/// edges are numbered in the order in which the faces first name them. Planes by Newell's method
/// through the mean of all vertices of the face; centroid and radius from the solid. Two faces make a
/// flat hull, on the plane of the first.
///
/// Topology is checked, convexity and planarity are the caller's promise. Throws ShapeError when the
/// polygons do not bound one solid without handles or leave a vertex unused, and for a face with more
/// than kMaxFaceVertices.
Hull<double> hull_from_polygons(std::vector<Vec3d> vertices,
                                const std::vector<std::vector<int>>& faces);

}  // namespace contactscope

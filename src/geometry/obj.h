#pragma once

#include "core/vec3.h"

namespace contactscope {

/// Points of a Wavefront .obj file, as input of build_hull: the vertices that its faces use, or all
/// vertices if the file has no face. Equal points are welded; the file's order, units and axes are
/// kept. Every `v` line is checked; materials, normals and texture coordinates are ignored. A
/// backslash at the end of a line joins it with the next one.
///
/// Throws InputError, with the line if possible: the file cannot be read, is not a regular file or
/// not .obj, a face has more than 10,000 corners, a coordinate is missing or not finite, a face
/// refers to a vertex that does not exist, or the file has no vertex.
std::vector<Vec3d> load_obj_vertices(const std::string& path);

/// Input of build_mesh.
struct ObjMesh {
  std::vector<Vec3d> vertices;                // all vertices, in the file's order
  std::vector<std::array<int, 3>> triangles;  // vertex indices, counted from 0
};

/// Triangles of a Wavefront .obj file: its faces in file order; triangulate_polygon cuts those with
/// more corners. Normals, texture coordinates and materials are ignored: the front of a face is
/// where its vertices run counter-clockwise. Faces without area are left to build_mesh.
///
/// Throws InputError as above, and without a face, or for one of fewer than three vertices.
ObjMesh load_obj_mesh(const std::string& path);

}  // namespace contactscope

#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/vec3.h"

namespace contactscope {

/// Points of a Wavefront .obj file for a hull to be built from: the vertices that its faces use, or
/// all of them when the file has no face. (Tools leave unused vertices behind; a hull must not grow
/// around them.) Equal points are welded, file order is kept. Units and axes are the file's own.
/// Every `v` line is checked; materials, normals and texture coordinates are ignored. A backslash at the
/// end of a line joins it with the next one.
///
/// Throws InputError, with the line where one is to blame: the file cannot be read, is not a regular
/// file or not .obj, a face has more than 10,000 corners, a coordinate is missing or not a finite
/// number, a face names a vertex that does not exist, or
/// there is no vertex at all.
std::vector<Vec3d> load_obj_vertices(const std::string& path);

/// What build_mesh needs, as a file has it.
struct ObjMesh {
  std::vector<Vec3d> vertices;                // all of the file, in its order
  std::vector<std::array<int, 3>> triangles;  // vertex indices, counted from 0
};

/// Triangles of a Wavefront .obj file: its faces in file order, those with more corners cut into
/// triangles (triangulate_polygon). Normals, texture coordinates and materials are ignored: the
/// front of a face is where its vertices run counter-clockwise. Faces without an area are left to
/// build_mesh.
///
/// Throws InputError as load_obj_vertices does, and where there is no face, or one has fewer than
/// three vertices.
ObjMesh load_obj_mesh(const std::string& path);

}  // namespace contactscope

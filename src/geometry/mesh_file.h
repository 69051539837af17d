#pragma once

#include "core/vec3.h"

/// Files of meshes by their extension, in upper or lower case: Wavefront .obj, .stl and .ply as text or
/// binary, and .off as text. Order, units and axes are those of the file. Materials, normals and
/// texture coordinates are ignored: the front of a face is where its vertices run counter-clockwise.
namespace contactscope {

/// Whether the extension is one of these.
bool is_mesh_file(const std::string& path);

/// Points as input of build_hull: the vertices that faces use, or all if the file has no face (tools
/// leave unused vertices behind, which must not enlarge the hull); equal ones once.
///
/// Throws InputError, with the line if possible: the file cannot be read, is not a regular file or of
/// another format, a face has more than 10,000 corners or a vertex that does not exist, a coordinate
/// is missing or not finite, or there is no vertex.
std::vector<Vec3d> load_vertices(const std::string& path);

/// Input of build_mesh.
struct FileMesh {
  std::vector<Vec3d> vertices;                // all vertices, in the file's order
  std::vector<std::array<int, 3>> triangles;  // vertex indices, counted from 0
};

/// Triangles: the faces in file order; triangulate_polygon cuts those with more corners. Faces without
/// area are left to build_mesh. Throws InputError as load_vertices does, and if there is no face or a
/// face has fewer than three vertices.
FileMesh load_mesh(const std::string& path);

}  // namespace contactscope

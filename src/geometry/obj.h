#pragma once

#include <string>
#include <vector>

#include "core/vec3.h"

namespace contactscope {

/// Points of a Wavefront .obj file for a hull to be built from: the vertices that its faces use, or
/// all of them when the file has no face. (Tools leave unused vertices behind; a hull must not grow
/// around them.) Equal points are welded, file order is kept. Units and axes are the file's own.
/// Every `v` line is checked; materials, normals and texture coordinates are ignored.
///
/// Throws InputError, with the line where one is to blame: the file cannot be read, is not .obj, a
/// coordinate is missing or not a finite number, a face names a vertex that does not exist, or
/// there is no vertex at all.
std::vector<Vec3d> load_obj_vertices(const std::string& path);

}  // namespace contactscope

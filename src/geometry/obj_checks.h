#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contactscope {

/// Goes over the text of a Wavefront .obj file once before tinyobjloader does, which reads what it
/// can and takes the rest as zero. Every vertex has three finite numbers and every face names
/// vertices that exist, or an InputError says where not, with `path`, line and column. Returns the
/// line of each face, counted from 1, in the order of the file.
std::vector<int> check_obj(const std::string& path, std::string_view text);

}  // namespace contactscope

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace contactscope {

/// Throws InputError where `path` is a pipe, a device or a socket: to open or read one may wait for ever.
/// A folder, and a path where nothing is, are left to whoever reads it. `wanted`: "give a scenario (.toml)".
void require_regular_file(const std::string& path, const std::string& wanted);

/// The name of a well-known format of meshes, robots or scenes that a file is in, by how it begins: "STL",
/// "URDF (XML)". Empty where it is none of them, or too little is there to say. `size`: of the whole file,
/// bytes.
std::string foreign_format(std::string_view begin, std::uintmax_t size);

/// What to say of such a file: what it is, and what is read instead. Empty where foreign_format() is.
std::string foreign_format_remedy(std::string_view begin, std::uintmax_t size);

}  // namespace contactscope

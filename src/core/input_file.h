#pragma once

#include "core/standard.h"

namespace contactscope {

/// Throws InputError if `path` is a pipe, device or socket: opening or reading one may block
/// forever. Folders and missing paths are left to the caller. `wanted`: "give a scenario (.toml)".
void require_regular_file(const std::string& path, const std::string& wanted);

/// Name of a well-known mesh, robot or scene format, detected from the first bytes: "STL", "URDF
/// (XML)". Empty for other or too short files. `size` is that of the whole file, in bytes.
std::string foreign_format(std::string_view begin, std::uintmax_t size);

/// Error message for such a file: its format and what to use instead. Empty for all other files.
std::string foreign_format_remedy(std::string_view begin, std::uintmax_t size);

}  // namespace contactscope

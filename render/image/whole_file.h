#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace contactscope {

/// Writes a file atomically: the bytes go to a hidden file in the same folder, which is then
/// renamed. Readers never see a partial file. Replaces an existing file. Throws
/// std::filesystem::filesystem_error with path and reason.
void write_whole_file(const std::string& path, std::span<const std::uint8_t> bytes);

/// Reads a regular file. Throws std::filesystem::filesystem_error, and std::runtime_error for a
/// pipe or device, which may be endless.
std::vector<std::uint8_t> read_whole_file(const std::string& path);

}  // namespace contactscope

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace contactscope {

/// Writes a file that is whole or absent, whoever reads meanwhile and wherever we are stopped: the
/// bytes go to a hidden name in the same folder, which is then renamed. Replaces an existing file.
/// Throws std::filesystem::filesystem_error with the path and the system's reason.
void write_whole_file(const std::string& path, std::span<const std::uint8_t> bytes);

/// All bytes of a regular file. Throws std::filesystem::filesystem_error, and std::runtime_error of a pipe or
/// a device, which may have no end.
std::vector<std::uint8_t> read_whole_file(const std::string& path);

}  // namespace contactscope

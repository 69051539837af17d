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

/// All bytes of a file. Throws std::filesystem::filesystem_error.
std::vector<std::uint8_t> read_whole_file(const std::string& path);

}  // namespace contactscope

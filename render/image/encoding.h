#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace contactscope {

using Bytes = std::vector<std::uint8_t>;

/// Fastest level of zlib_stream().
inline constexpr int kFastestDeflate = 1;

/// Compresses to a zlib stream (RFC 1950). `level` is 0 (stored) to 12 (smallest); 1 is the fastest
/// that compresses. Deterministic on one machine; level 1 may find other matches on another type of
/// processor. Thread-safe.
Bytes zlib_stream(std::span<const std::uint8_t> bytes, int level);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits, like `sha256sum`.
std::string sha256(std::string_view bytes);

/// Compresses to a gzip file (RFC 1952) without name and time.
std::string gzip(std::string_view bytes);

/// Decompresses a gzip file with one member. Throws std::runtime_error if it is invalid, truncated,
/// or holds more than 2 GiB.
std::string gunzip(std::string_view file);

// whole_file.cpp

/// Writes a file atomically: the bytes go to a hidden file in the same folder, which is then
/// renamed. Readers never see a partial file. Replaces an existing file. Throws
/// std::filesystem::filesystem_error with path and reason.
void write_whole_file(const std::string& path, std::span<const std::uint8_t> bytes);

/// Reads a regular file. Throws std::filesystem::filesystem_error, and std::runtime_error for a
/// pipe or device, which may be endless.
std::vector<std::uint8_t> read_whole_file(const std::string& path);

}  // namespace contactscope

#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/deflate.h"
#include "image/image.h"
#include "image/png_chunks.h"

namespace contactscope {

/// Invalid PNG data. what() has the path.
class PngError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Encodes a PNG of 8 bits per channel, RGB, or RGBA if the picture has alpha. `level` is that of
/// zlib_stream(), 0 (stored) to 12 (smallest); level 1 takes 1 to 2.5 ms for 1280x720. The picture
/// must not be empty. Deterministic on one machine. Thread-safe.
std::vector<std::uint8_t> encode_png(const Image& image, int level = kFastestDeflate,
                                     const PngText& text = {});

/// Writes encode_png(); the file is complete or absent. Throws std::filesystem::filesystem_error.
void write_png(const std::string& path, const Image& image, int level = kFastestDeflate,
               const PngText& text = {});

/// Reads any PNG as 8-bit RGB without alpha. Throws std::filesystem::filesystem_error if the file
/// is unreadable, PngError if it is not a PNG.
Image read_png(const std::string& path);

/// Decodes bytes; `name` identifies them in a PngError.
Image decode_png(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace contactscope

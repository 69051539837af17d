#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/image.h"

namespace contactscope {

/// Bytes that are no PNG, or one that cannot be decoded. what() carries the path.
class PngError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// An 8-bit RGB PNG, or RGBA of an image with alpha. `level` is libdeflate's, 0 (stored) to 12 (smallest); level 1 takes 8 ms for
/// 1280x720. The picture has at least one pixel. Equal pictures give equal bytes. May be called
/// from several threads at once.
std::vector<std::uint8_t> encode_png(const Image& image, int level = 1);

/// encode_png() into a file that is whole or absent. Throws std::filesystem::filesystem_error.
void write_png(const std::string& path, const Image& image, int level = 1);

/// Reads any PNG as 8-bit RGB; alpha is dropped. Throws std::filesystem::filesystem_error when the
/// file cannot be read and PngError when it is no PNG.
Image read_png(const std::string& path);

}  // namespace contactscope

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

/// Bytes that are no PNG, or one that cannot be decoded. what() carries the path.
class PngError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A PNG of 8 bits a channel, RGB, with alpha where the picture has some. `level` is that
/// of zlib_stream(), 0 (stored) to 12 (smallest); level 1 takes 1 to 2.5 ms for 1280x720. The picture has at
/// least one pixel. Equal pictures with equal texts give equal bytes on one machine. May be called from
/// several threads at once.
std::vector<std::uint8_t> encode_png(const Image& image, int level = kFastestDeflate,
                                     const PngText& text = {});

/// encode_png() into a file that is whole or absent. Throws std::filesystem::filesystem_error.
void write_png(const std::string& path, const Image& image, int level = kFastestDeflate,
               const PngText& text = {});

/// Reads any PNG as 8-bit RGB; alpha is dropped. Throws std::filesystem::filesystem_error when the
/// file cannot be read and PngError when it is no PNG.
Image read_png(const std::string& path);

/// The same of bytes; `name` is what they are called in the PngError.
Image decode_png(std::span<const std::uint8_t> bytes, const std::string& name);

/// What a PNG says of itself, without looking at its pixels. Throws as read_png() does.
PngText read_png_text(const std::string& path);

}  // namespace contactscope

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/compare.h"
#include "image/deflate.h"
#include "image/image.h"

/// Parts of PNG and APNG files. PNG specification, third edition, W3C 2025.
namespace contactscope {

/// Keywords (1 to 79 letters) and values (UTF-8).
using PngText = std::vector<std::pair<std::string, std::string>>;

inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

/// Big-endian.
void append_be32(std::uint32_t value, Bytes& to);
void append_be16(std::uint16_t value, Bytes& to);

/// A chunk: length, four-letter type, data, checksum.
void append_chunk(std::string_view type, std::span<const std::uint8_t> data, Bytes& to);

/// Signature and header for 8 bits per channel: RGB, or RGBA if the picture has alpha.
void append_png_begin(const Image& image, Bytes& to);
/// One chunk per text: tEXt for ASCII, else iTXt.
void append_png_text(const PngText& text, Bytes& to);

/// Compressed rows of a part of a picture, unfiltered: the data of IDAT and fdAT. The box has at
/// least one pixel; `level` is that of zlib_stream().
Bytes deflated_rows(const Image& image, const PixelBox& box, int level);

}  // namespace contactscope

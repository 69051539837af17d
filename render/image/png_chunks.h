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

/// What PNG files and animated ones consist of. PNG specification, third edition, W3C 2025.
namespace contactscope {

/// What a picture says of itself: keyword, of 1 to 79 letters, and value, UTF-8.
using PngText = std::vector<std::pair<std::string, std::string>>;

inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

/// Four bytes, the most significant one first.
void append_be32(std::uint32_t value, Bytes& to);
void append_be16(std::uint16_t value, Bytes& to);

/// A chunk: length, type of four letters, what is in it, checksum.
void append_chunk(std::string_view type, std::span<const std::uint8_t> data, Bytes& to);

/// Signature and header of a picture of 8 bits a channel: RGB, and alpha where it has some.
void append_png_begin(const Image& image, Bytes& to);
/// A chunk for each text: tEXt where it is plain ASCII, else iTXt.
void append_png_text(const PngText& text, Bytes& to);

/// Rows of part of a picture, each behind the byte that names its filter (none), as a zlib stream: what
/// IDAT and fdAT hold. The box has at least one pixel; `level` is that of zlib_stream().
Bytes deflated_rows(const Image& image, const PixelBox& box, int level);

}  // namespace contactscope

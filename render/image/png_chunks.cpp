#include "image/png_chunks.h"

#include <libdeflate.h>

#include <algorithm>
#include <cassert>
#include <memory>

namespace contactscope {
namespace {

bool is_plain(const std::string& text) {
  return std::ranges::all_of(text, [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
}

void append(std::string_view text, Bytes& to) { to.insert(to.end(), text.begin(), text.end()); }

}  // namespace

void append_be32(std::uint32_t value, Bytes& to) {
  for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<std::uint8_t>(value >> shift));
}

void append_be16(std::uint16_t value, Bytes& to) {
  to.push_back(static_cast<std::uint8_t>(value >> 8));
  to.push_back(static_cast<std::uint8_t>(value));
}

void append_chunk(std::string_view type, std::span<const std::uint8_t> data, Bytes& to) {
  assert(type.size() == 4);
  append_be32(static_cast<std::uint32_t>(data.size()), to);
  const std::size_t begin = to.size();
  append(type, to);
  to.insert(to.end(), data.begin(), data.end());
  append_be32(libdeflate_crc32(0, to.data() + begin, to.size() - begin), to);
}

void append_png_begin(const Image& image, Bytes& to) {
  constexpr std::uint8_t kRgb = 2, kRgba = 6;
  append(kPngSignature, to);
  Bytes header;
  append_be32(static_cast<std::uint32_t>(image.width), header);
  append_be32(static_cast<std::uint32_t>(image.height), header);
  // Bits per channel, colour type, compression, filter method, not interlaced.
  for (const std::uint8_t byte : {std::uint8_t{8}, image.alpha.empty() ? kRgb : kRgba,
                                  std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0}})
    header.push_back(byte);
  append_chunk("IHDR", header, to);
}

void append_png_text(const PngText& text, Bytes& to) {
  for (const auto& [key, value] : text) {
    assert(!key.empty() && key.size() < 80 && is_plain(key));
    Bytes data;
    append(key, data);
    data.push_back(0);
    // Not compressed, no language, no translated keyword.
    if (!is_plain(value)) data.insert(data.end(), 4, 0);
    append(value, data);
    append_chunk(is_plain(value) ? "tEXt" : "iTXt", data, to);
  }
}

Bytes deflated_rows(const Image& image, const PixelBox& box, int level) {
  assert(box.right > box.left && box.bottom > box.top && level >= 0 && level <= 12);
  const auto index = [](int n) { return static_cast<std::size_t>(n); };
  const std::size_t channels = image.alpha.empty() ? 3 : 4;
  const std::size_t width = index(box.right - box.left), row = 1 + channels * width;
  // Flat areas and thin lines compress as well unfiltered, twice as fast. The buffer of some
  // megabytes is written once, so it is not cleared before.
  const std::size_t size = row * index(box.bottom - box.top);
  const auto rows = std::make_unique_for_overwrite<std::uint8_t[]>(size);
  for (int y = box.top; y < box.bottom; ++y) {
    const std::size_t first = index(y) * index(image.width) + index(box.left);
    const std::uint8_t* rgb = image.rgb.data() + 3 * first;
    std::uint8_t* to = rows.get() + index(y - box.top) * row;
    *to++ = 0;  // no filter
    if (channels == 3) {
      std::copy_n(rgb, 3 * width, to);
      continue;
    }
    for (std::size_t x = 0; x < width; ++x, rgb += 3, to += 4) {
      std::copy_n(rgb, 3, to);
      to[3] = image.alpha[first + x];
    }
  }
  return zlib_stream({rows.get(), size}, level);
}

}  // namespace contactscope

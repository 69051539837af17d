#include "image/png.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <memory>

#include "image/whole_file.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb/stb_image.h>

namespace contactscope {
namespace {

std::uint32_t be32(const std::uint8_t* at) {
  return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 |
         at[3];
}

bool has_signature(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kPngSignature.size() &&
         std::equal(kPngSignature.begin(), kPngSignature.end(), bytes.begin(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, int level, const PngText& text) {
  assert(image.width > 0 && image.height > 0 && level >= 0 && level <= 12);
  Bytes png;
  append_png_begin(image, png);
  append_png_text(text, png);  // before the pixels, where `head -c` and viewers find it
  append_chunk("IDAT", deflated_rows(image, {0, 0, image.width, image.height}, level), png);
  append_chunk("IEND", {}, png);
  return png;
}

void write_png(const std::string& path, const Image& image, int level, const PngText& text) {
  write_whole_file(path, encode_png(image, level, text));
}

Image decode_png(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw PngError(name + ": cannot be read as a PNG: larger than 2 GB");
  }
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height,
                            &channels, 3),
      stbi_image_free);
  if (!pixels) {
    throw PngError(name + ": cannot be read as a PNG: " +
                   (has_signature(bytes) ? "it is cut off or damaged" : "it is not one"));
  }
  Image image(width, height);
  image.rgb.assign(pixels.get(), pixels.get() + image.rgb.size());
  return image;
}

Image read_png(const std::string& path) { return decode_png(read_whole_file(path), path); }

PngText read_png_text(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_whole_file(path);
  if (!has_signature(bytes)) throw PngError(path + ": cannot be read as a PNG: it is not one");
  PngText text;
  for (std::size_t at = kPngSignature.size(); at + 12 <= bytes.size();) {
    const std::size_t length = be32(&bytes[at]);
    if (length > bytes.size() - at - 12)
      throw PngError(path + ": cannot be read as a PNG: it is cut off or damaged");
    const auto* data = reinterpret_cast<const char*>(&bytes[at + 8]);
    const std::string_view type(data - 4, 4), all(data, length);
    const std::size_t end = std::min(all.find('\0'), length);
    const std::string key(all.substr(0, end));
    if (type == "tEXt" && end < length) text.emplace_back(key, all.substr(end + 1));
    // Only uncompressed iTXt: two flags, a language and a translated keyword.
    if (type == "iTXt" && end + 2 < length && all[end + 1] == 0) {
      const std::size_t keyword = all.find('\0', end + 3);
      const std::size_t value = keyword == all.npos ? keyword : all.find('\0', keyword + 1);
      if (value != all.npos) text.emplace_back(key, all.substr(value + 1));
    }
    at += 12 + length;
  }
  return text;
}

}  // namespace contactscope

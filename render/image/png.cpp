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

}  // namespace contactscope

#include "image/png.h"

#include <libdeflate.h>

#include <cassert>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>

#include "image/whole_file.h"

namespace {

// stb takes the level from a global; encoders run in several threads with a level each.
thread_local int compression_level = 1;

/// stb_image_write's hook: a zlib stream in memory that free() releases, or null.
unsigned char* compress(unsigned char* data, int length, int* out_length, int /*stb's level*/) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(compression_level), libdeflate_free_compressor);
  if (!compressor) return nullptr;
  const std::size_t input = static_cast<std::size_t>(length);
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), input);
  unsigned char* out = static_cast<unsigned char*>(std::malloc(bound));
  if (!out) return nullptr;
  *out_length =
      static_cast<int>(libdeflate_zlib_compress(compressor.get(), data, input, out, bound));
  return out;
}

unsigned checksum(const unsigned char* data, int length) {
  return libdeflate_crc32(0, data, static_cast<std::size_t>(length));
}

}  // namespace

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STBIW_ZLIB_COMPRESS compress
#define STBIW_CRC32 checksum
#include <stb/stb_image_write.h>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb/stb_image.h>

namespace contactscope {
namespace {

std::vector<std::uint8_t> interleaved(const Image& image) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * image.alpha.size());
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    const std::uint8_t* const rgb = &image.rgb[3 * i];
    rgba.insert(rgba.end(), {rgb[0], rgb[1], rgb[2], image.alpha[i]});
  }
  return rgba;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, int level) {
  assert(image.width > 0 && image.height > 0 && level >= 0 && level <= 12);
  // Flat areas and thin lines compress as well unfiltered, and twice as fast.
  static const int filter = stbi_write_force_png_filter = 0;
  static_cast<void>(filter);
  compression_level = level;
  int length = 0;
  const int channels = image.alpha.empty() ? 3 : 4;
  std::vector<std::uint8_t> rgba;
  if (channels == 4) rgba = interleaved(image);
  const std::unique_ptr<unsigned char, void (*)(void*)> png(
      stbi_write_png_to_mem(channels == 4 ? rgba.data() : image.rgb.data(), channels * image.width,
                            image.width, image.height, channels, &length),
      std::free);
  if (!png) throw std::bad_alloc();
  return {png.get(), png.get() + length};
}

void write_png(const std::string& path, const Image& image, int level) {
  write_whole_file(path, encode_png(image, level));
}

Image read_png(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_whole_file(path);
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw PngError(path + ": cannot be read as a PNG: larger than 2 GB");
  }
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height,
                            &channels, 3),
      stbi_image_free);
  if (!pixels) {
    throw PngError(path + ": cannot be read as a PNG: " + stbi_failure_reason());
  }
  Image image(width, height);
  image.rgb.assign(pixels.get(), pixels.get() + image.rgb.size());
  return image;
}

}  // namespace contactscope

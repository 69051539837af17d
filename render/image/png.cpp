#include "image/png.h"

#include <libdeflate.h>

#include <cassert>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <system_error>

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

std::vector<std::uint8_t> encode_png(const Image& image, int level) {
  assert(image.width > 0 && image.height > 0 && level >= 0 && level <= 12);
  // Flat areas and thin lines compress as well unfiltered, and twice as fast.
  static const int filter = stbi_write_force_png_filter = 0;
  static_cast<void>(filter);
  compression_level = level;
  int length = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> png(
      stbi_write_png_to_mem(image.rgb.data(), 3 * image.width, image.width, image.height, 3,
                            &length),
      std::free);
  if (!png) throw std::bad_alloc();
  return {png.get(), png.get() + length};
}

void write_png(const std::string& path, const Image& image, int level) {
  write_whole_file(path, encode_png(image, level));
}

Image read_png(const std::string& path) {
  const auto fail = [&path](int error) {
    throw std::filesystem::filesystem_error("cannot read", path,
                                            std::error_code(error, std::generic_category()));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) fail(errno);
  std::vector<std::uint8_t> bytes;
  std::uint8_t block[65536];
  while (const std::size_t count = std::fread(block, 1, sizeof block, file.get())) {
    bytes.insert(bytes.end(), block, block + count);
  }
  if (std::ferror(file.get())) fail(errno);
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

#include "image/gzip.h"

#include <libdeflate.h>

#include <memory>
#include <stdexcept>

namespace contactscope {

std::string gzip(std::string_view bytes) {
  constexpr int kLevel = 9;  // written once, read by every clone
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string file(libdeflate_gzip_compress_bound(compressor.get(), bytes.size()), '\0');
  file.resize(libdeflate_gzip_compress(compressor.get(), bytes.data(), bytes.size(), file.data(),
                                       file.size()));
  return file;
}

std::string gunzip(std::string_view file) {
  constexpr std::size_t kMin = 18, kMax = std::size_t{2} << 30;  // header and trailer
  const auto fail = [] { throw std::runtime_error("it is not a complete gzip file"); };
  if (file.size() < kMin) fail();
  // The last four bytes are the size, little-endian.
  std::size_t size = 0;
  for (std::size_t i = 0; i < 4; ++i)
    size |= std::size_t{static_cast<unsigned char>(file[file.size() - 4 + i])} << (8 * i);
  // Deflate expands by a factor of at most about a thousand.
  if (size > kMax || size / 1100 > file.size()) fail();
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
      decompressor(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor) throw std::bad_alloc();
  std::string bytes(size, '\0');
  std::size_t written = 0;
  if (libdeflate_gzip_decompress(decompressor.get(), file.data(), file.size(), bytes.data(), size,
                                 &written) != LIBDEFLATE_SUCCESS ||
      written != size)
    fail();
  return bytes;
}

}  // namespace contactscope

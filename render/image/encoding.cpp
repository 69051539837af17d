#include "image/deflate.h"

#include <isa-l/igzip_lib.h>
#include <libdeflate.h>

#include <array>
#include <cassert>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

namespace contactscope {
namespace {

std::uint32_t as_u32(std::size_t size) { return static_cast<std::uint32_t>(size); }

// For stored files, which justify the time.
Bytes small_stream(std::span<const std::uint8_t> bytes, int level) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), bytes.size());
  const auto out = std::make_unique_for_overwrite<std::uint8_t[]>(bound);
  const std::size_t length =
      libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.get(), bound);
  return {out.get(), out.get() + length};
}

// Writing sequences is limited by encoding: ISA-L compresses 1280x720 in 1 to 2.5 ms, level 1 of
// libdeflate in 13 to 19 ms. Its files are 5 to 12 % larger.
Bytes fast_stream(std::span<const std::uint8_t> bytes) {
  constexpr int kLevel = 2;  // as fast as level 1 on pictures, and 1 % smaller
  if (bytes.size() > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("more than 4 GB cannot be compressed at once");
  const auto work = std::make_unique_for_overwrite<std::uint8_t[]>(ISAL_DEF_LVL2_DEFAULT);
  isal_zstream stream;
  isal_deflate_init(&stream);
  stream.level = kLevel;
  stream.level_buf = work.get();
  stream.level_buf_size = ISAL_DEF_LVL2_DEFAULT;
  stream.gzip_flag = IGZIP_ZLIB;
  stream.end_of_stream = 1;
  stream.flush = NO_FLUSH;
  // Not modified; the C interface lacks const.
  stream.next_in = const_cast<std::uint8_t*>(bytes.data());
  stream.avail_in = as_u32(bytes.size());

  std::array<std::uint8_t, 1 << 16> piece;
  Bytes out;
  do {
    stream.next_out = piece.data();
    stream.avail_out = as_u32(piece.size());
    if (isal_deflate(&stream) != COMP_OK)
      throw std::runtime_error("a picture cannot be compressed");
    out.insert(out.end(), piece.begin(), piece.end() - stream.avail_out);
  } while (stream.internal_state.state != ZSTATE_END);
  return out;
}

}  // namespace

Bytes zlib_stream(std::span<const std::uint8_t> bytes, int level) {
  assert(level >= 0 && level <= 12);
  return level == kFastestDeflate ? fast_stream(bytes) : small_stream(bytes, level);
}

}  // namespace contactscope

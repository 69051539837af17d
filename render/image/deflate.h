#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace contactscope {

using Bytes = std::vector<std::uint8_t>;

/// The level of zlib_stream() that takes the least time.
inline constexpr int kFastestDeflate = 1;

/// A zlib stream (RFC 1950) of bytes. `level` is 0 (stored) to 12 (smallest); 1 is the fastest one that
/// compresses. Equal bytes give equal streams on one machine; level 1 may find other matches on another
/// kind of processor. May be called from several threads at once.
Bytes zlib_stream(std::span<const std::uint8_t> bytes, int level);

}  // namespace contactscope

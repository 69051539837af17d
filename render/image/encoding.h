#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace contactscope {

using Bytes = std::vector<std::uint8_t>;

/// Fastest level of zlib_stream().
inline constexpr int kFastestDeflate = 1;

/// Compresses to a zlib stream (RFC 1950). `level` is 0 (stored) to 12 (smallest); 1 is the fastest
/// that compresses. Deterministic on one machine; level 1 may find other matches on another type of
/// processor. Thread-safe.
Bytes zlib_stream(std::span<const std::uint8_t> bytes, int level);

}  // namespace contactscope

#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "core/at.h"

namespace contactscope::viewer {

/// An integer that the next one is predicted to equal, and the number of bits of the last difference.
struct Last {
  std::int32_t value = 0;
  int bits = 0;
};

/// An adaptive binary range coder of differences: their number of bits, by the field and the bits of
/// the last difference, their two upper bits by the field, and the others as they are. data.js
/// decodes it.
class Coder {
 public:
  static constexpr int kContexts = 33, kSlots = 32;                // of one context
  static constexpr int kFieldSlots = kContexts * kSlots + 4 * 33;  // then two bits for each length

  explicit Coder(int fields) : chances_(static_cast<std::size_t>(fields * kFieldSlots), 1 << 15) {}

  /// Codes the difference to `last`, which then has this value.
  void put(int field, std::int32_t value, Last& last) {
    // Wraps around on overflow, as in JavaScript.
    const std::uint32_t difference =
        static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(last.value);
    const std::uint32_t zigzag =
        (difference << 1) ^ (difference >> 31 != 0 ? ~std::uint32_t{0} : 0);
    const int bits = std::bit_width(zigzag), slots = field * kFieldSlots;
    const int context = slots + last.bits * kSlots;
    put_bit(context, bits > 0);
    for (int i = 4, node = 1; bits > 0 && i >= 0; --i)
      node = 2 * node + put_bit(context + node, (bits - 1) >> i & 1);
    int left = bits - 1;
    for (int node = 1; left > 0 && node < 4; --left)
      node = 2 * node + put_bit(slots + kContexts * kSlots + 4 * (bits - 1) + node,
                                static_cast<int>(zigzag >> (left - 1) & 1));
    while (left > 0) {
      const int some = std::min(left, 16);
      left -= some;
      range_ >>= some;
      add(range_ * (zigzag >> left & ((1u << some) - 1)));
      shift();
    }
    last = {value, bits};
  }

  std::string bytes() const {
    std::string all = bytes_;
    for (int i = 24; i >= 0; i -= 8) all += static_cast<char>(low_ >> i & 0xff);
    return all;
  }

 private:
  int put_bit(int slot, int bit) {
    std::uint16_t& zero = at(chances_, slot);
    const std::uint32_t bound = (range_ >> 16) * zero;
    if (bit != 0) add(bound);
    range_ = bit != 0 ? range_ - bound : bound;
    zero = static_cast<std::uint16_t>(zero + (bit != 0 ? -(zero >> 5) : (65536 - zero) >> 5));
    shift();
    return bit;
  }
  void add(std::uint32_t more) {
    low_ += more;
    bool carries = low_ < more;
    for (std::size_t i = bytes_.size(); carries && i > 0;) carries = ++bytes_[--i] == 0;
  }
  void shift() {
    for (; range_ < 1 << 24; range_ <<= 8, low_ <<= 8) bytes_ += static_cast<char>(low_ >> 24);
  }

  std::vector<std::uint16_t> chances_;  // of a zero, times 2^16
  std::uint32_t low_ = 0, range_ = ~std::uint32_t{0};
  std::string bytes_;
};

}  // namespace contactscope::viewer

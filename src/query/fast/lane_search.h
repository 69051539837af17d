#pragma once

#include "core/pack.h"

namespace contactscope {

/// Bit i is set if `test`, a test of packs, is true for values[i], for up to 64 values. `count` is
/// a multiple of the lane width. Branchless, because the best of many faces is unpredictable.
template <class S, class Test>
inline std::uint64_t bits_where(const S* values, int count, const Test& test) {
  const int most = std::min(count, 64);
  std::uint64_t bits = 0;
  for (int i = 0; i < most; i += lanes::kWidth<S>)
    bits |= std::uint64_t{lanes::bits<S>(test(lanes::load(values + i)))} << i;
  return bits;
}

/// Positions where a test is true.
struct Hits {
  int first = -1;  // -1: none
  bool is_single = false;
};

template <class S, class Test> inline Hits hits(const S* values, int count, const Test& test) {
  Hits result;
  for (int from = 0; from < count; from += 64) {
    const std::uint64_t bits = bits_where(values + from, count - from, test);
    if (bits == 0) continue;
    result.is_single = result.first < 0 && (bits & (bits - 1)) == 0;
    if (result.first < 0) result.first = from + std::countr_zero(bits);
  }
  return result;
}

}  // namespace contactscope

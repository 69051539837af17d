#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "core/manifold.h"

namespace contactscope::lanes {

/// A register's worth of numbers, as GCC and Clang spell it: four floats or two doubles on any
/// processor with SSE2 or NEON. Operators work lane by lane; comparisons give integers of the same
/// width, -1 where they hold.
template <class S>
struct Wide {
  typedef S Type __attribute__((vector_size(16)));  // NOLINT(modernize-use-using): GCC wants it so
};
template <class S>
using Pack = typename Wide<S>::Type;
template <class S>
using Flags = decltype(Pack<S>{} < Pack<S>{});

template <class S>
inline constexpr int kWidth = static_cast<int>(16 / sizeof(S));

template <class S>
inline Pack<S> load(const S* from) {
  Pack<S> pack;
  std::memcpy(&pack, from, sizeof pack);
  return pack;
}

template <class S>
inline void store(const Pack<S>& pack, S* to) {
  std::memcpy(to, &pack, sizeof pack);
}

/// value(0), value(1), ... side by side.
template <class S, class Value>
inline Pack<S> each(const Value& value) {
  if constexpr (kWidth<S> == 4) {
    return Pack<S>{value(0), value(1), value(2), value(3)};
  } else {
    return Pack<S>{value(0), value(1)};
  }
}

/// One number in all lanes.
template <class S>
inline Pack<S> all(S value) {
  return each<S>([value](int) { return value; });
}

template <class P>
inline P larger(const P& a, const P& b) {
  return a > b ? a : b;
}
template <class P>
inline P smaller(const P& a, const P& b) {
  return a < b ? a : b;
}

/// The lanes from `kFirst` on of two packs that follow each other. To load them instead would wait
/// for the two to be written, where they just were.
template <class S, int kFirst>
inline Pack<S> straddle(const Pack<S>& a, const Pack<S>& b) {
  if constexpr (kFirst == 0) {
    return a;
  } else if constexpr (kWidth<S> == 2) {
    return __builtin_shufflevector(a, b, kFirst, kFirst + 1);
  } else if constexpr (kFirst == 2) {
    return __builtin_shufflevector(a, b, 2, 3, 4, 5);
  } else {
    // In two steps that SSE2 has. GCC takes nine for the whole.
    const Pack<S> amid = __builtin_shufflevector(a, b, 3, 3, 4, 4);
    if constexpr (kFirst == 1) return __builtin_shufflevector(a, amid, 1, 2, 4, 6);
    return __builtin_shufflevector(amid, b, 0, 2, 5, 6);
  }
}

/// Bit i is set where lane i of a comparison holds.
template <class S>
inline std::uint32_t bits(const Flags<S>& flags) {
#ifdef __SSE2__
  if constexpr (sizeof(S) == 4) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(flags)));
  } else {
    return static_cast<std::uint32_t>(_mm_movemask_pd(reinterpret_cast<__m128d>(flags)));
  }
#else
  std::uint32_t set = 0;
  for (int lane = 0; lane < kWidth<S>; ++lane) {
    set |= static_cast<std::uint32_t>(flags[lane] & 1) << lane;
  }
  return set;
#endif
}

/// The largest and the smallest of all lanes, in every lane; without a branch, which nothing could
/// foresee.
template <class S>
inline Pack<S> largest(Pack<S> pack) {
  if constexpr (kWidth<S> == 4) pack = larger(pack, Pack<S>{pack[2], pack[3], pack[0], pack[1]});
  return larger(pack, each<S>([&](int lane) { return pack[lane ^ 1]; }));
}
template <class S>
inline Pack<S> smallest(Pack<S> pack) {
  if constexpr (kWidth<S> == 4) pack = smaller(pack, Pack<S>{pack[2], pack[3], pack[0], pack[1]});
  return smaller(pack, each<S>([&](int lane) { return pack[lane ^ 1]; }));
}

/// kWidth numbers of the four that begin a contact point, its position and separation, from number
/// `first` on.
template <class S>
inline Pack<S> load(const ContactPoint<S>& point, int first) {
  static_assert(sizeof(point.position) == 3 * sizeof(S));
  static_assert(sizeof(ContactPoint<S>) >= 4 * sizeof(S));
  Pack<S> pack;
  std::memcpy(&pack, reinterpret_cast<const std::byte*>(&point) + first * sizeof(S), sizeof pack);
  return pack;
}

}  // namespace contactscope::lanes

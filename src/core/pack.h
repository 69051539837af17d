#pragma once

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "core/manifold.h"

namespace contactscope::lanes {

/// SIMD vector of `kLanes` numbers, in the GCC and Clang extension. Operators work lane by lane.
/// Comparisons give integers of the same width, -1 for true.
template <class S, int kLanes> struct Vector {
  // NOLINTNEXTLINE(modernize-use-using): GCC requires a typedef
  typedef S Type __attribute__((vector_size(kLanes * sizeof(S))));
};

/// Four floats or two doubles: a register of any processor with SSE2 or NEON.
template <class S> inline constexpr int kWidth = static_cast<int>(16 / sizeof(S));
template <class S> using Pack = typename Vector<S, kWidth<S>>::Type;
template <class S> using Flags = decltype(Pack<S>{} < Pack<S>{});

/// The widest pack of this build: with -march=x86-64-v3 eight floats or four doubles.
#ifdef __AVX2__
template <class S> inline constexpr int kWidest = 2 * kWidth<S>;
#else
template <class S> inline constexpr int kWidest = kWidth<S>;
#endif
template <class S> using Widest = typename Vector<S, kWidest<S>>::Type;

/// Number of lanes of a pack of numbers `S`.
template <class S, class P> inline constexpr int kLanesOf = static_cast<int>(sizeof(P) / sizeof(S));

template <class P, class S> inline P load_pack(const S* from) {
  P pack;
  std::memcpy(&pack, from, sizeof pack);
  return pack;
}
template <class S> inline Pack<S> load(const S* from) { return load_pack<Pack<S>>(from); }

template <class S, class P> inline void store(const P& pack, S* to) {
  std::memcpy(to, &pack, sizeof pack);
}

/// {value(0), value(1), ...}.
template <class P, class Value> inline P pack_of(const Value& value) {
  using S = decltype(value(0));
  constexpr int kLanes = kLanesOf<S, P>;
  if constexpr (kLanes == 8) {
    return P{value(0), value(1), value(2), value(3), value(4), value(5), value(6), value(7)};
  } else if constexpr (kLanes == 4) {
    return P{value(0), value(1), value(2), value(3)};
  } else {
    return P{value(0), value(1)};
  }
}
template <class S, class Value> inline Pack<S> each(const Value& value) {
  return pack_of<Pack<S>>([&value](int lane) -> S { return value(lane); });
}

template <class S> inline Pack<S> all(S value) {
  return each<S>([value](int) { return value; });
}

template <class P> inline P larger(const P& a, const P& b) { return a > b ? a : b; }
template <class P> inline P smaller(const P& a, const P& b) { return a < b ? a : b; }

/// Lanes kFirst, kFirst + 1, ... of the concatenation of a and b. Loading them from memory would
/// stall while recent stores of a and b complete.
template <class S, int kFirst, class P> inline P straddle(const P& a, const P& b) {
  constexpr int kLanes = kLanesOf<S, P>;
  if constexpr (kFirst == 0) {
    return a;
  } else if constexpr (kLanes == 8) {
    return __builtin_shufflevector(a, b, kFirst, kFirst + 1, kFirst + 2, kFirst + 3, kFirst + 4,
                                   kFirst + 5, kFirst + 6, kFirst + 7);
  } else if constexpr (kLanes == 2) {
    return __builtin_shufflevector(a, b, kFirst, kFirst + 1);
  } else if constexpr (kFirst == 2 || kWidest<S> != kWidth<S>) {
    return __builtin_shufflevector(a, b, kFirst, kFirst + 1, kFirst + 2, kFirst + 3);
  } else {
    // Two shuffles that SSE2 has. GCC takes nine steps for a single shuffle.
    const P amid = __builtin_shufflevector(a, b, 3, 3, 4, 4);
    if constexpr (kFirst == 1) return __builtin_shufflevector(a, amid, 1, 2, 4, 6);
    return __builtin_shufflevector(amid, b, 0, 2, 5, 6);
  }
}

/// Bit i is set when lane i of a comparison of numbers `S` is true.
template <class S, class F> inline std::uint32_t bits(const F& flags) {
#ifdef __AVX2__
  if constexpr (sizeof(F) == 32 && sizeof(S) == 4) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(reinterpret_cast<__m256>(flags)));
  } else if constexpr (sizeof(F) == 32) {
    return static_cast<std::uint32_t>(_mm256_movemask_pd(reinterpret_cast<__m256d>(flags)));
  } else
#endif
#ifdef __SSE2__
      if constexpr (sizeof(S) == 4) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(flags)));
  } else {
    return static_cast<std::uint32_t>(_mm_movemask_pd(reinterpret_cast<__m128d>(flags)));
  }
#else
  {
    std::uint32_t set = 0;
    for (int lane = 0; lane < kLanesOf<S, F>; ++lane)
      set |= static_cast<std::uint32_t>(flags[lane] & 1) << lane;
    return set;
  }
#endif
}

/// Reduces all lanes with `choose` and broadcasts the result. Avoids an unpredictable branch.
template <class S, class P, class Choose> inline P of_all_lanes(P pack, const Choose& choose) {
  constexpr int kLanes = kLanesOf<S, P>;
  if constexpr (kLanes == 8) pack = choose(pack, straddle<S, 4>(pack, pack));
  if constexpr (kLanes >= 4) {
    pack = choose(pack, pack_of<P>([&](int lane) -> S { return pack[lane ^ 2]; }));
  }
  return choose(pack, pack_of<P>([&](int lane) -> S { return pack[lane ^ 1]; }));
}
template <class S, class P> inline P largest(const P& pack) {
  return of_all_lanes<S>(pack, [](const P& a, const P& b) { return larger(a, b); });
}
template <class S, class P> inline P smallest(const P& pack) {
  return of_all_lanes<S>(pack, [](const P& a, const P& b) { return smaller(a, b); });
}

/// Loads kWidth numbers of a contact point (position, separation) from index `first` on.
template <class S> inline Pack<S> load(const ContactPoint<S>& point, int first) {
  static_assert(sizeof(point.position) == 3 * sizeof(S));
  static_assert(sizeof(ContactPoint<S>) >= 4 * sizeof(S));
  Pack<S> pack;
  std::memcpy(&pack, reinterpret_cast<const std::byte*>(&point) + first * sizeof(S), sizeof pack);
  return pack;
}

}  // namespace contactscope::lanes

#pragma once

#include <cstring>

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

template <class P>
inline P larger(const P& a, const P& b) {
  return a > b ? a : b;
}
template <class P>
inline P smaller(const P& a, const P& b) {
  return a < b ? a : b;
}

/// Over all lanes; without a branch, which nothing could foresee.
template <class S>
inline S largest(Pack<S> pack) {
  if constexpr (kWidth<S> == 4) pack = larger(pack, Pack<S>{pack[2], pack[3], pack[0], pack[1]});
  pack = larger(pack, each<S>([&](int lane) { return pack[lane ^ 1]; }));
  return pack[0];
}
template <class S>
inline S smallest(const Pack<S>& pack) {
  return -largest<S>(-pack);
}

}  // namespace contactscope::lanes

#pragma once

#include <cassert>
#include <cstddef>
#include <utility>

namespace contactscope {

/// Element i >= 0 of a sequence. Features, points and triangles are numbered by int here, because a
/// number that is none is -1.
template <class Sequence>
constexpr decltype(auto) at(Sequence&& sequence, int i) {
  assert(i >= 0);
  return std::forward<Sequence>(sequence)[static_cast<std::size_t>(i)];
}

/// How many elements it has, as such a number.
template <class Sequence>
constexpr int count_of(const Sequence& sequence) {
  return static_cast<int>(sequence.size());
}

}  // namespace contactscope

#pragma once

#include "core/vec3.h"

namespace contactscope {

/// x + y + z in the order in which dot(), norm() and their like of three-vectors of S add, so that a loop
/// over lanes finds the same bits as they: Eigen adds up a whole register first where one holds two
/// numbers, and halves the sum where none is full. `P` is S or a pack of them.
template <class S, class P>
[[gnu::always_inline]] inline P dot_sum(const P& x, const P& y, const P& z) {
  using Packet = typename Eigen::internal::find_best_packet<S, 3>::type;
  if constexpr (Eigen::internal::unpacket_traits<Packet>::size == 2) return (x + y) + z;
  return x + (y + z);
}

}  // namespace contactscope

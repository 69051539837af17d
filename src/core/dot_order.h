#pragma once

#include "core/vec3.h"

namespace contactscope {

/// x + y + z, in the order in which Eigen's dot(), norm() etc. of three-vectors of S add. A loop
/// over lanes then gives the same bits. Eigen sums a register of two numbers first; without a full
/// register it halves the sum. `P` is S or a pack of S.
template <class S, class P>
[[gnu::always_inline]] inline P dot_sum(const P& x, const P& y, const P& z) {
  using Packet = typename Eigen::internal::find_best_packet<S, 3>::type;
  if constexpr (Eigen::internal::unpacket_traits<Packet>::size == 2) return (x + y) + z;
  return x + (y + z);
}

}  // namespace contactscope

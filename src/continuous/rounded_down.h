#pragma once

#include <cmath>

namespace contactscope {

/// Casts a safe time >= 0 (no impact before it) to another scalar.
template <class S>
S rounded_down(double time) {
  const S near = static_cast<S>(time);
  return static_cast<double>(near) > time ? std::nextafter(near, S(0)) : near;
}

}  // namespace contactscope

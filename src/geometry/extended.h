#pragma once

#include <cmath>
#include <limits>

namespace contactscope {

/// The smallest number of the scalar type that is not below `value`.
template <class S>
S rounded_up(long double value) {
  const S nearest = static_cast<S>(value);
  return static_cast<long double>(nearest) < value
             ? std::nextafter(nearest, std::numeric_limits<S>::infinity())
             : nearest;
}

}  // namespace contactscope

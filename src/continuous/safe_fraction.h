#pragma once

#include <algorithm>
#include <cmath>

namespace contactscope {

/// Lower bound of the separation along a fixed axis between two times at which it is known. A point
/// with an acceleration up to k is off the straight line between its ends by at most k u (1 - u)
/// width^2 / 2 at the fraction u. A minimum of lines is never below its chord.
///
/// Returns the fraction up to which the bound is above `target` (< `at_begin`); 1 if it always is.
template <class S>
S safe_fraction(S at_begin, S at_end, S acceleration, S width, S target) {
  const S sag = S(0.5) * acceleration * width * width;
  const S c = at_begin - target;        // > 0
  const S b = at_end - at_begin - sag;  // the bound: sag u^2 + b u + c
  if (!(b < S(0))) return 1;
  const S discriminant = b * b - S(4) * sag * c;
  if (discriminant < S(0)) return 1;
  // The smaller root, in the form without cancellation.
  const S root = S(2) * c / (-b + std::sqrt(discriminant));
  return std::min(root, S(1));
}

}  // namespace contactscope

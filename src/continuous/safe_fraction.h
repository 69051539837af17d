#pragma once

#include <algorithm>
#include <cmath>

namespace contactscope {

/// A lower bound of the separation along a fixed axis between two times at which it is known. A point
/// that is accelerated by no more than k is off the straight line between two of its places by no
/// more than k u (1 - u) width^2 / 2 at the fraction u between them; and the least of many straight
/// lines is nowhere below the straight line between its ends.
///
/// Returns the fraction up to which the bound is above `target`; 1 where it is all the way.
/// `at_begin` > target.
template <class S>
S safe_fraction(S at_begin, S at_end, S acceleration, S width, S target) {
  const S sag = S(0.5) * acceleration * width * width;
  const S c = at_begin - target;        // > 0
  const S b = at_end - at_begin - sag;  // the bound: sag u^2 + b u + c
  if (!(b < S(0))) return 1;
  const S discriminant = b * b - S(4) * sag * c;
  if (discriminant < S(0)) return 1;
  // The smaller root, by the form in which nothing cancels.
  const S root = S(2) * c / (-b + std::sqrt(discriminant));
  return std::min(root, S(1));
}

}  // namespace contactscope

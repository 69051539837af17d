#pragma once

#include <optional>

#include "continuous/moving_polygon.h"

namespace contactscope {

/// Before `end` the origin was in the polygon once, at the place u, v or near.
struct ContactRoot {
  double end;  // fraction of the step
  double u, v;
};

/// Proves that two features meet: that d[0] + u (d[1] - d[0]) + v (d[last] - d[0]) = 0 has a solution
/// at a time of the step and a place on the features near those given. Nothing where the proof fails,
/// as it does for what touches only a border or grazes.
///
/// Newton's steps lead to the root. A box about it is then mapped into itself by Krawczyk's operator,
/// so that it holds a root of the exact equation (Krawczyk 1969; Moore 1977, "A Test for Existence of
/// Solutions to Nonlinear Systems"). Rounding is bounded by multiples of 2^-53 of the terms.
template <int kCorners>
std::optional<ContactRoot> prove_contact(const MovingPolygon<kCorners>& polygon, double time,
                                         double u, double v);

}  // namespace contactscope

#pragma once

#include <optional>

#include "continuous/moving_polygon.h"

namespace contactscope {

/// Proved contact: the origin is in the polygon at some time before `end`, at or near u, v.
struct ContactRoot {
  double end;  // fraction of the step
  double u, v;
};

/// Proves that two features meet: that d[0] + u (d[1] - d[0]) + v (d[last] - d[0]) = 0 has a
/// solution at a time of the step and a place on the features near those given. Returns nullopt if
/// the proof fails, as it does for contacts at a border and grazing contacts.
///
/// Newton's method finds the root. Krawczyk's operator then maps a box about it into itself, so the
/// box contains a root of the exact equation (Krawczyk 1969; Moore 1977, "A Test for Existence of
/// Solutions to Nonlinear Systems"). Rounding is bounded by multiples of 2^-53 of the terms.
template <int kCorners>
std::optional<ContactRoot> prove_contact(const MovingPolygon<kCorners>& polygon, double time,
                                         double u, double v);

}  // namespace contactscope

#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/manifold.h"
#include "trace/trace.h"

namespace contactscope {

/// Gregorius 2015, "Contact Point Reduction: 1st Point" to "4th Point (6)", looked at from the
/// answer: for each of the `kept` points, in the order of choice, what each candidate was worth. Of
/// a fourth or later point the measure of the edge that decides (the least signed area, or for
/// "distance" the least signed distance; negative outside), and of the chosen one those of all
/// edges. "AABB (1)" to "(3)", extremes: a support point for each. Empty for reducers that do not
/// choose in these steps, and where all points were kept.
std::vector<trace::Choice> choices_made(std::string_view reducer,
                                        std::span<const ContactPoint<double>> points,
                                        const Vec3d& normal, std::span<const int> kept);

}  // namespace contactscope

#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/manifold.h"

namespace contactscope {

/// What one point was worth at one step.
struct ChoiceMeasure {
  int point = -1;
  int a = -1, b = -1;  // the edge it was measured against, where it was one
  double value = 0;    // metres; for "triangle" and "outside" signed square metres
};

/// One step of the talk's reduction, for those who watch.
struct ChoiceMade {
  /// "support", "deepest", "farthest", "triangle", "outside", "distance".
  const char* rule = "";
  Vec3d direction = Vec3d::Zero();  // unit, of "support"
  std::vector<ChoiceMeasure> measures;
};

/// Gregorius 2015, "Contact Point Reduction: 1st Point" to "4th Point (6)", looked at from the
/// answer: for each of the `kept` points, in the order of choice, what each candidate was worth. Of
/// a fourth or later point the measure of the edge that decides (the least signed area, or for
/// "distance" the least signed distance; negative outside), and of the chosen one those of all
/// edges. Empty for reducers that do not choose in these steps, and where all points were kept.
std::vector<ChoiceMade> choices_made(std::string_view reducer,
                                     std::span<const ContactPoint<double>> points,
                                     const Vec3d& normal, std::span<const int> kept);

}  // namespace contactscope

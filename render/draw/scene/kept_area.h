#pragma once

#include <vector>

#include "draw/scene/legend.h"
#include "trace/trace.h"

/// The area that the points which a reducer kept hold up: the same in the scene and in the contact plane.
namespace contactscope::draw {

/// The points that a reducer kept, around their border: what they hold up. Less than three where they have no area.
std::vector<Vec3d> kept_polygon(const trace::Reduction& reduction, const Vec3d& normal);

inline constexpr float kKeptFill = 0.22f;  // strength of that area
/// A kept point, and the border of that area.
inline constexpr Swatch kSpannedSwatch{LegendGroup::Points, 11, [](auto& pen) {
                                         pen.level_line(-4, 26, 2, kContact);
                                         pen.dot(0, 8.2, kWhite);
                                         pen.dot(0, 3.6, kContact);
                                         pen.dot(6.2, 8.2, kContact);
                                       }};
inline constexpr const char* kSpannedWords = "kept, in order of choice, and their area";

}  // namespace contactscope::draw

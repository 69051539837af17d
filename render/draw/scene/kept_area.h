#pragma once

#include <vector>

#include "draw/scene/legend.h"
#include "trace/trace.h"

/// The area spanned by the points that a reducer kept, for the scene and for the contact plane.
namespace contactscope::draw {

/// Convex border of the points that a reducer kept. Fewer than three points if they have no area.
std::vector<Vec3d> kept_polygon(const trace::Reduction& reduction, const Vec3d& normal);

inline constexpr float kKeptFill = 0.22f;  // opacity of that area
/// Legend sign: a kept point and the border of that area.
inline constexpr Swatch kSpannedSwatch{LegendGroup::Points, 11, [](auto& pen) {
                                         pen.level_line(-4, 26, 2, kContact);
                                         pen.dot(0, 8.2, kWhite);
                                         pen.dot(0, 3.6, kContact);
                                         pen.dot(6.2, 8.2, kContact);
                                       }};
inline constexpr const char* kSpannedWords = "kept, in order of choice, and their area";

}  // namespace contactscope::draw

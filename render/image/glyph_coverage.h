#pragma once

#include <cstdint>
#include <vector>

namespace contactscope {

/// Corner of a closed polygon, pixels, y down.
struct ContourPoint {
  double x = 0, y = 0;
};
using Contour = std::vector<ContourPoint>;

/// Exact area of each pixel inside an outline, in 255 steps, rows from the top. Contours of one
/// winding are solid, those of the other are holes. Outlines must stay within the bitmap.
///
/// Glyphs are not rasterized by the library that reads the font, so that labels have the same
/// pixels with every version of it. Sums of areas in double, without fused multiply-adds, are also
/// the same on every processor.
std::vector<std::uint8_t> coverage_of(const std::vector<Contour>& outline, int width, int height);

}  // namespace contactscope

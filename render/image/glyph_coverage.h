#pragma once

#include <cstdint>
#include <vector>

namespace contactscope {

/// Corners of a closed polygon, pixels, y down.
struct ContourPoint {
  double x = 0, y = 0;
};
using Contour = std::vector<ContourPoint>;

/// The exact share of each pixel that lies inside of an outline, rounded to 255 steps: rows from the
/// top. Contours of one winding are solid and those of the other are holes; outlines stay within
/// the bitmap.
///
/// Letters are rasterized here and not by the library that reads the font, so that a label has the
/// same pixels whatever version of that library a distribution has. Sums of areas in double, without
/// fused multiply-adds, are the same on every processor, too.
std::vector<std::uint8_t> coverage_of(const std::vector<Contour>& outline, int width, int height);

}  // namespace contactscope

#pragma once

#include <cmath>
#include <cstdint>

#include "image/image.h"

namespace contactscope {

/// A white picture with one vermilion dot, radius 5 pixels, with a soft edge.
inline Image dot_picture(double x, double y, int width = 160, int height = 90) {
  Image image(width, height);
  const double dot[3] = {0xD5, 0x5E, 0x00};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double distance = std::hypot(column + 0.5 - x, row + 0.5 - y);
      const double coverage = std::fmin(1, std::fmax(0, 5.5 - distance));
      for (int channel = 0; channel < 3; ++channel) {
        image.rgb[static_cast<std::size_t>(3 * (row * width + column) + channel)] =
            static_cast<std::uint8_t>(std::lround(255 + coverage * (dot[channel] - 255)));
      }
    }
  }
  return image;
}

}  // namespace contactscope

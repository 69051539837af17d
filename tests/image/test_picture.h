#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "image/image.h"

/// A small software painter for pictures with soft edges; shares nothing with the rasterizer.
namespace contactscope::testing {

struct Rgb {
  double r, g, b;  // 0 to 255
};

inline void blend(Image& image, int x, int y, const Rgb& color, double coverage) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height || coverage <= 0) return;
  std::uint8_t* pixel =
      &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                      static_cast<std::size_t>(x))];
  const double channels[] = {color.r, color.g, color.b};
  for (int c = 0; c < 3; ++c) {
    const double mixed = pixel[c] + (channels[c] - pixel[c]) * std::min(coverage, 1.0);
    pixel[c] = static_cast<std::uint8_t>(std::lround(mixed));
  }
}

inline void paint_all(Image& image, const Rgb& color) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) blend(image, x, y, color, 1);
  }
}

inline void paint_rectangle(Image& image, int left, int top, int right, int bottom,
                            const Rgb& color) {
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) blend(image, x, y, color, 1);
  }
}

inline void paint_dot(Image& image, double cx, double cy, double radius, const Rgb& color) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double distance = std::hypot(x + 0.5 - cx, y + 0.5 - cy);
      blend(image, x, y, color, radius + 0.5 - distance);
    }
  }
}

/// 97 x 41, white, with a vermilion dot whose centre is `x` from the left.
inline Image dot_on_white(double x) {
  Image image(97, 41);
  paint_all(image, {255, 255, 255});
  paint_dot(image, x, 20, 6, {213, 94, 0});
  return image;
}

inline void paint_line(Image& image, double x0, double y0, double x1, double y1, double width,
                       const Rgb& color) {
  const double dx = x1 - x0, dy = y1 - y0, squared = dx * dx + dy * dy;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double px = x + 0.5 - x0, py = y + 0.5 - y0;
      const double t = std::clamp((px * dx + py * dy) / squared, 0.0, 1.0);
      const double distance = std::hypot(px - t * dx, py - t * dy);
      blend(image, x, y, color, width / 2 + 0.5 - distance);
    }
  }
}

}  // namespace contactscope::testing

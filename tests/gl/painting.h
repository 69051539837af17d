#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "gl/rasterizer.h"

namespace contactscope::testing {

using Pixel = std::array<int, 3>;

inline Pixel pixel(const Image& image, int x, int y) {
  const std::uint8_t* p = &image.rgb[3 * static_cast<std::size_t>(y * image.width + x)];
  return {p[0], p[1], p[2]};
}

inline Image paint(gl::Rasterizer& rasterizer, const draw::Drawing& drawing) {
  rasterizer.paint(drawing);
  return rasterizer.read();
}

inline Image paint(gl::Context& context, int width, int height,
                   std::vector<draw::Primitive> primitives) {
  gl::Rasterizer rasterizer(context, width, height);
  draw::Drawing drawing;
  drawing.width = width;
  drawing.height = height;
  drawing.primitives = std::move(primitives);
  return paint(rasterizer, drawing);
}

/// Black ink on white in pixels: the sum of coverage, to 1/255 of a pixel each.
inline double ink(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) sum += (255 - image.rgb[i]) / 255.0;
  return sum;
}

}  // namespace contactscope::testing

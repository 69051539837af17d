#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace contactscope {

/// sRGB red, green and blue, one byte each, rows from the top, no padding; optionally alpha for a
/// transparent background.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;      // 3 * width * height
  std::vector<std::uint8_t> alpha{};  // width * height, not premultiplied; empty: opaque

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace contactscope

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace contactscope {

/// Pixels, three bytes each (sRGB red, green, blue), rows from the top, no padding; and
/// where what lies beneath is to be seen, how much of it they cover.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;      // 3 * width * height
  std::vector<std::uint8_t> alpha{};  // width * height, straight; empty: opaque

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  friend bool operator==(const Image&, const Image&) = default;
};

}  // namespace contactscope

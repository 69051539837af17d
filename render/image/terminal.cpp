#include "image/png.h"

#include <algorithm>
#include <array>

namespace contactscope {
namespace {

const std::uint8_t* pixel(const Image& image, int x, int y) {
  return &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(x))];
}

}  // namespace

std::string to_kitty(std::string_view png) {
  constexpr std::size_t kPiece = 4096;
  const std::string all = base64(png);
  std::string text;
  for (std::size_t begin = 0; begin < all.size(); begin += kPiece) {
    text += begin == 0 ? "\033_Gf=100,a=T,m=" : "\033_Gm=";
    text += begin + kPiece < all.size() ? "1;" : "0;";
    text += all.substr(begin, kPiece) + "\033\\";
  }
  return text + "\n";
}

Image shrunk(const Image& image, int width) {
  if (image.width <= width) return image;
  const int height = std::max(1, image.height * width / image.width);
  Image small(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int left = x * image.width / width, right = (x + 1) * image.width / width;
      const int top = y * image.height / height, bottom = (y + 1) * image.height / height;
      std::array<int, 3> sum{};
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u)
          for (std::size_t channel = 0; channel < 3; ++channel)
            sum[channel] += pixel(image, u, v)[channel];
      const int count = (right - left) * (bottom - top);
      for (std::size_t channel = 0; channel < 3; ++channel)
        small.rgb[3 * (static_cast<std::size_t>(y * width + x)) + channel] =
            static_cast<std::uint8_t>((sum[channel] + count / 2) / count);
    }
  }
  return small;
}

std::string to_half_blocks(const Image& image, int columns) {
  const Image small = shrunk(image, columns);
  const auto colour = [&](const char* which, int x, int y) {
    const std::uint8_t* const rgb = pixel(small, x, y);
    return std::string("\033[") + which + ";2;" + std::to_string(rgb[0]) + ";" +
           std::to_string(rgb[1]) + ";" + std::to_string(rgb[2]) + "m";
  };
  std::string text;
  for (int y = 0; y + 1 < small.height; y += 2) {
    std::string before;
    for (int x = 0; x < small.width; ++x) {
      const std::string both = colour("38", x, y) + colour("48", x, y + 1);
      if (both != before) text += both;
      before = both;
      text += "\xE2\x96\x80";  // upper half block
    }
    text += "\033[0m\n";
  }
  return text;
}

}  // namespace contactscope

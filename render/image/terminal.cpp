#include "image/terminal.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "image/base64.h"

namespace contactscope {
namespace {

const std::uint8_t* pixel(const Image& image, int x, int y) {
  return &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(x))];
}

constexpr int kLevels = 6;  // per channel

int palette_index(const std::uint8_t* rgb) {
  int index = 0;
  for (int channel = 0; channel < 3; ++channel)
    index = kLevels * index + (rgb[channel] * (kLevels - 1) + 127) / 255;
  return index;
}

void add_run(std::string& text, char what, int count) {
  if (count > 3)
    text += "!" + std::to_string(count) + what;
  else
    text.append(static_cast<std::size_t>(count), what);
}

/// One colour of six rows: a character per column, with a bit per row.
std::string band_of(const std::vector<std::array<int, 6>>& columns, int colour) {
  std::string text;
  char last = 0;
  int count = 0;
  for (const std::array<int, 6>& rows : columns) {
    int bits = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) bits |= (rows[row] == colour) << row;
    const char what = static_cast<char>('?' + bits);
    if (what != last && count > 0) add_run(text, last, std::exchange(count, 0));
    last = what;
    ++count;
  }
  add_run(text, last, count);
  return text;
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

std::string to_sixel(const Image& image) {
  std::string text =
      "\033Pq\"1;1;" + std::to_string(image.width) + ";" + std::to_string(image.height);
  for (int index = 0; index < kLevels * kLevels * kLevels; ++index) {
    text += "#" + std::to_string(index) + ";2";
    for (const int level :
         {index / (kLevels * kLevels), index / kLevels % kLevels, index % kLevels})
      text += ";" + std::to_string(100 * level / (kLevels - 1));
  }
  for (int top = 0; top < image.height; top += 6) {
    std::vector<std::array<int, 6>> columns(static_cast<std::size_t>(image.width));
    std::vector<bool> used(kLevels * kLevels * kLevels);
    for (int x = 0; x < image.width; ++x) {
      std::array<int, 6>& rows = columns[static_cast<std::size_t>(x)];
      for (int row = 0; row < 6; ++row) {
        const int colour =
            top + row < image.height ? palette_index(pixel(image, x, top + row)) : -1;
        rows[static_cast<std::size_t>(row)] = colour;
        if (colour >= 0) used[static_cast<std::size_t>(colour)] = true;
      }
    }
    for (std::size_t colour = 0; colour < used.size(); ++colour) {
      if (!used[colour]) continue;
      const int index = static_cast<int>(colour);
      text += "#" + std::to_string(index) + band_of(columns, index) + "$";
    }
    text += "-";
  }
  return text + "\033\\\n";
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

#include "image/compare.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace contactscope {
namespace {

std::size_t index(int width, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(x);
}

/// Differences of two pictures, on a canvas that holds both.
struct DifferenceMask {
  int width, height;
  std::vector<std::uint8_t> differs = std::vector<std::uint8_t>(index(width, 0, height));
  int count = 0;
  int largest_channel_difference = 0;
};

int channel_difference(const Image& a, const Image& b, int x, int y) {
  const std::uint8_t* pixel_a = &a.rgb[3 * index(a.width, x, y)];
  const std::uint8_t* pixel_b = &b.rgb[3 * index(b.width, x, y)];
  int largest = 0;
  for (int channel = 0; channel < 3; ++channel)
    largest = std::max(largest, std::abs(pixel_a[channel] - pixel_b[channel]));
  return largest;
}

DifferenceMask find_differences(const Image& a, const Image& b, int tolerance) {
  DifferenceMask mask{std::max(a.width, b.width), std::max(a.height, b.height)};
  const int both_wide = std::min(a.width, b.width), both_high = std::min(a.height, b.height);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const bool in_both = x < both_wide && y < both_high;
      const int difference = in_both ? channel_difference(a, b, x, y) : 255;
      mask.largest_channel_difference = std::max(mask.largest_channel_difference, difference);
      mask.differs[index(mask.width, x, y)] = difference > tolerance;
      mask.count += difference > tolerance;
    }
  }
  return mask;
}

struct Cluster {
  int size = 0;
  PixelBox box;
};

/// Removes the 8-connected group of (x, y) from the mask.
Cluster take_cluster(DifferenceMask& mask, int x, int y) {
  struct Pixel {
    int x, y;
  };
  Cluster cluster{0, {x, y, x + 1, y + 1}};
  std::vector<Pixel> open{{x, y}};
  mask.differs[index(mask.width, x, y)] = 0;
  while (!open.empty()) {
    const Pixel at = open.back();
    open.pop_back();
    ++cluster.size;
    PixelBox& box = cluster.box;
    box = {std::min(box.left, at.x), std::min(box.top, at.y), std::max(box.right, at.x + 1),
           std::max(box.bottom, at.y + 1)};
    for (int ny = std::max(at.y - 1, 0); ny <= std::min(at.y + 1, mask.height - 1); ++ny) {
      for (int nx = std::max(at.x - 1, 0); nx <= std::min(at.x + 1, mask.width - 1); ++nx) {
        std::uint8_t& differs = mask.differs[index(mask.width, nx, ny)];
        if (!differs) continue;
        differs = 0;
        open.push_back({nx, ny});
      }
    }
  }
  return cluster;
}

/// The largest group; the first in reading order if several are equal.
Cluster largest_cluster(DifferenceMask mask) {
  Cluster largest;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (!mask.differs[index(mask.width, x, y)]) continue;
      const Cluster cluster = take_cluster(mask, x, y);
      if (cluster.size > largest.size) largest = cluster;
    }
  }
  return largest;
}

void set_pixel(Image& image, int x, int y, const std::array<std::uint8_t, 3>& rgb) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  std::ranges::copy(rgb, &image.rgb[3 * index(image.width, x, y)]);
}

/// Draws a frame of `thickness` pixels at a distance of `gap` pixels around the box.
void draw_frame(Image& image, const PixelBox& box, int gap, int thickness) {
  const int outer = gap + thickness;
  for (int y = box.top - outer; y < box.bottom + outer; ++y) {
    for (int x = box.left - outer; x < box.right + outer; ++x) {
      const bool inside =
          x >= box.left - gap && x < box.right + gap && y >= box.top - gap && y < box.bottom + gap;
      if (!inside) set_pixel(image, x, y, {0x00, 0x72, 0xB2});
    }
  }
}

}  // namespace

PixelComparison compare_pixels(const Image& expected, const Image& actual,
                               const PixelLimits& limits) {
  if (expected.width != actual.width || expected.height != actual.height)
    return {.verdict = PixelVerdict::SizeDiffers};
  if (expected.rgb == actual.rgb) return {};
  const DifferenceMask mask = find_differences(expected, actual, limits.channel);
  const Cluster cluster = largest_cluster(mask);
  const bool fails = cluster.size >= limits.cluster || mask.count > limits.total;
  return {fails ? PixelVerdict::Different : PixelVerdict::WithinTolerance, mask.count, cluster.size,
          cluster.box, mask.largest_channel_difference};
}

Image difference_image(const Image& expected, const Image& actual) {
  DifferenceMask mask = find_differences(expected, actual, kChannelTolerance);
  Image out(mask.width, mask.height);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.differs[index(mask.width, x, y)]) {
        set_pixel(out, x, y, {0xD5, 0x5E, 0x00});
        continue;
      }
      const std::uint8_t* pixel = &expected.rgb[3 * index(expected.width, x, y)];
      // Rec. 601 luma, then one third of the contrast on white.
      const int luma = (299 * pixel[0] + 587 * pixel[1] + 114 * pixel[2] + 500) / 1000;
      const auto ghost = static_cast<std::uint8_t>(255 - (255 - luma) / 3);
      set_pixel(out, x, y, {ghost, ghost, ghost});
    }
  }
  const Cluster cluster = largest_cluster(std::move(mask));
  if (cluster.size > 0) draw_frame(out, cluster.box, 4, 2);
  return out;
}

}  // namespace contactscope

#pragma once

#include "image/image.h"

namespace contactscope {

/// Pixels that differ by at most this in every channel count as equal. Processors with only SSE2
/// round this far.
inline constexpr int kChannelTolerance = 2;
/// A group of this many touching pixels is a defect. The smallest real defect tried, a dot moved by
/// two pixels, made a group of 19; another software driver made groups of two.
inline constexpr int kClusterLimit = 8;
/// More differing pixels than this are a defect, however scattered. Another software driver made
/// 40.
inline constexpr int kTotalLimit = 100;

/// Limits of equality. The defaults are for pictures of the same rasterizer.
struct PixelLimits {
  int channel = kChannelTolerance;  // largest difference that counts as equal
  int cluster = kClusterLimit;      // a group of this many touching pixels fails
  int total = kTotalLimit;          // more differing pixels fail
  friend bool operator==(const PixelLimits&, const PixelLimits&) = default;
};

enum class PixelVerdict { Identical, WithinTolerance, Different, SizeDiffers };

/// A rectangle of pixels; right and bottom are exclusive.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

struct PixelComparison {
  PixelVerdict verdict = PixelVerdict::Identical;
  int differing = 0;                   // pixels with a channel off by more than the limit
  int largest_cluster = 0;             // pixels of their largest 8-connected group
  PixelBox largest_cluster_at{};       // bounding box of that group; empty without one
  int largest_channel_difference = 0;  // over all pixels, 0 to 255

  bool passed() const {
    return verdict == PixelVerdict::Identical || verdict == PixelVerdict::WithinTolerance;
  }
};

/// Compares two pictures. Equal bytes pass. Differing pixels fail by the size of their largest
/// group or by their number; different sizes fail. The mean error is not used, because it ranks a
/// driver's rounding far above a lost dot.
PixelComparison compare_pixels(const Image& expected, const Image& actual,
                               const PixelLimits& limits = {});

/// Visualizes differences: `expected` as a pale grey ghost, differing pixels in vermilion, and a
/// blue frame around their largest group. For different sizes the picture covers both, and pixels
/// in only one of them differ.
Image difference_image(const Image& expected, const Image& actual);

}  // namespace contactscope

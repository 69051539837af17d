#pragma once

#include "image/image.h"

namespace contactscope {

/// Pixels that differ by no more than this in every channel count as equal: processors without
/// more than SSE2 round this far.
inline constexpr int kChannelTolerance = 2;
/// A group of this many touching pixels is a defect. The smallest real one that was tried, a dot
/// moved by two pixels, made a group of 19; another software driver made groups of two.
inline constexpr int kClusterLimit = 8;
/// More differing pixels than this are a defect however they are scattered; another software
/// driver made 40.
inline constexpr int kTotalLimit = 100;

/// What two pictures may differ by. The defaults are for pictures of the same rasterizer.
struct PixelLimits {
  int channel = kChannelTolerance;  // pixels that differ by no more count as equal
  int cluster = kClusterLimit;      // a group of so many touching pixels fails
  int total = kTotalLimit;          // more of them fail
  friend bool operator==(const PixelLimits&, const PixelLimits&) = default;
};

enum class PixelVerdict { Identical, WithinTolerance, Different, SizeDiffers };

/// A rectangle of pixels: left and top are inside, right and bottom are not.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

struct PixelComparison {
  PixelVerdict verdict = PixelVerdict::Identical;
  int differing = 0;                   // pixels with a channel off by more than the limit
  int largest_cluster = 0;             // pixels of the largest 8-connected group of them
  PixelBox largest_cluster_at{};       // bounding box of that group; empty without one
  int largest_channel_difference = 0;  // over all pixels, 0 to 255

  bool passed() const {
    return verdict == PixelVerdict::Identical || verdict == PixelVerdict::WithinTolerance;
  }
};

/// Whether `actual` shows the same picture as `expected`. Equal bytes pass; else the pixels that
/// differ fail it by the size of their largest group or by their number. Pictures of different size fail and are not looked at further. No mean
/// error takes part: it ranks a driver's rounding far above a lost dot.
PixelComparison compare_pixels(const Image& expected, const Image& actual,
                               const PixelLimits& limits = {});

/// A picture for people: `expected` as a pale grey ghost, differing pixels in vermilion, and a blue
/// frame around the largest group of them. Where sizes differ it is as large as both together, and
/// what only one of them covers differs.
Image difference_image(const Image& expected, const Image& actual);

}  // namespace contactscope

#include "image/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "image/test_picture.h"

namespace contactscope {
namespace {

using testing::paint_all;
using testing::paint_dot;
using testing::paint_line;
using testing::paint_rectangle;
using testing::Rgb;

constexpr Rgb kVermilion{213, 94, 0};
constexpr Rgb kBlue{0, 114, 178};

struct SceneOptions {
  double dot_x = 120.3, dot_y = 80.7;
  bool with_dot = true;
  Rgb patch = kBlue;
};

/// A filled patch, a few soft lines, and contact dots of 4 px radius.
Image scene(const SceneOptions& options = {}) {
  Image image(240, 160);
  paint_all(image, {255, 255, 255});
  paint_rectangle(image, 60, 50, 180, 120, options.patch);
  paint_line(image, 20.2, 30.1, 220.9, 140.4, 2, {0, 158, 115});
  paint_line(image, 30, 140, 200, 20, 1.5, {0, 0, 0});
  paint_dot(image, 75.5, 60.2, 4, kVermilion);
  if (options.with_dot) paint_dot(image, options.dot_x, options.dot_y, 4, kVermilion);
  return image;
}

std::uint8_t& channel(Image& image, int x, int y, int c) {
  return image.rgb[3 * static_cast<std::size_t>(y * image.width + x) + static_cast<std::size_t>(c)];
}

TEST(ComparePixels, EqualBytesAreIdentical) {
  const PixelComparison result = compare_pixels(scene(), scene());
  EXPECT_EQ(result.verdict, PixelVerdict::Identical);
  EXPECT_TRUE(result.passed());
  EXPECT_EQ(result.differing, 0);
  EXPECT_EQ(result.largest_channel_difference, 0);
}

TEST(ComparePixels, CatchesADotMovedByTwoPixels) {
  for (const auto& [dx, dy] : {std::pair{2.0, 0.0}, {0.0, -2.0}, {1.5, 1.5}}) {
    SceneOptions moved;
    moved.dot_x += dx;
    moved.dot_y += dy;
    const PixelComparison result = compare_pixels(scene(), scene(moved));
    EXPECT_EQ(result.verdict, PixelVerdict::Different) << dx << ", " << dy;
    EXPECT_GE(result.largest_cluster, kClusterLimit);
    EXPECT_LE(result.differing, kTotalLimit) << "only the cluster may give it away";
  }
}

TEST(ComparePixels, CatchesAMissingDotAndReportsWhere) {
  SceneOptions missing;
  missing.with_dot = false;
  const PixelComparison result = compare_pixels(scene(), scene(missing));
  EXPECT_EQ(result.verdict, PixelVerdict::Different);
  const PixelBox box = result.largest_cluster_at;
  EXPECT_NEAR((box.left + box.right) / 2.0, 120.3, 1);
  EXPECT_NEAR((box.top + box.bottom) / 2.0, 80.7, 1);
  EXPECT_LE(box.right - box.left, 10);
  EXPECT_GE(box.right - box.left, 8);
}

TEST(ComparePixels, CatchesAColourOffByATenth) {
  SceneOptions off;
  off.patch = {0.9 * kBlue.r, 0.9 * kBlue.g, 0.9 * kBlue.b};
  const PixelComparison result = compare_pixels(scene(), scene(off));
  EXPECT_EQ(result.verdict, PixelVerdict::Different);
  EXPECT_NEAR(result.largest_channel_difference, 0.1 * kBlue.b, 1);
}

TEST(ComparePixels, CatchesABlankPicture) {
  Image blank(240, 160);
  EXPECT_EQ(compare_pixels(scene(), blank).verdict, PixelVerdict::Different);
  paint_all(blank, {255, 255, 255});
  EXPECT_EQ(compare_pixels(scene(), blank).verdict, PixelVerdict::Different);
}

TEST(ComparePixels, CatchesAWrongSize) {
  const PixelComparison result = compare_pixels(scene(), Image(160, 240));
  EXPECT_EQ(result.verdict, PixelVerdict::SizeDiffers);
  EXPECT_FALSE(result.passed());
  EXPECT_EQ(compare_pixels(scene(), Image()).verdict, PixelVerdict::SizeDiffers);
}

TEST(ComparePixels, AcceptsRoundingOfTwoStepsEverywhere) {
  Image rounded = scene();
  std::mt19937 random(7);
  std::uniform_int_distribution<int> noise(-2, 2);
  for (std::uint8_t& value : rounded.rgb) {
    value = static_cast<std::uint8_t>(std::clamp(value + noise(random), 0, 255));
  }
  const PixelComparison result = compare_pixels(scene(), rounded);
  EXPECT_EQ(result.verdict, PixelVerdict::WithinTolerance);
  EXPECT_EQ(result.differing, 0);
  EXPECT_EQ(result.largest_channel_difference, 2);
}

TEST(ComparePixels, CountsAStepOfThreeInOneChannel) {
  Image other = scene();
  for (int x = 100; x < 108; ++x) channel(other, x, 10, 2) = 252;
  const PixelComparison result = compare_pixels(scene(), other);
  EXPECT_EQ(result.verdict, PixelVerdict::Different);
  EXPECT_EQ(result.largest_cluster, 8);
  EXPECT_EQ(result.largest_cluster_at, (PixelBox{100, 10, 108, 11}));
  channel(other, 104, 10, 2) = 253;  // splits the run in four and three
  EXPECT_EQ(compare_pixels(scene(), other).verdict, PixelVerdict::WithinTolerance);
}

TEST(ComparePixels, AcceptsFortyScatteredPixelsInPairs) {
  Image scattered = scene();
  for (int i = 0; i < 20; ++i) {
    const int x = 10 + 11 * i, y = 5 + 7 * (i % 20);
    channel(scattered, x, y, 0) ^= 0x40;
    channel(scattered, x + 1, y + 1, 1) ^= 0x20;  // touches by a corner
  }
  const PixelComparison result = compare_pixels(scene(), scattered);
  EXPECT_EQ(result.verdict, PixelVerdict::WithinTolerance);
  EXPECT_EQ(result.differing, 40);
  EXPECT_EQ(result.largest_cluster, 2);
}

TEST(ComparePixels, CatchesManyScatteredPixels) {
  const auto speckled = [](int count) {
    Image image = scene();
    for (int i = 0; i < count; ++i) channel(image, 4 + 4 * (i % 50), 4 + 4 * (i / 50), 1) ^= 0x40;
    return image;
  };
  EXPECT_EQ(compare_pixels(scene(), speckled(100)).verdict, PixelVerdict::WithinTolerance);
  EXPECT_EQ(compare_pixels(scene(), speckled(101)).verdict, PixelVerdict::Different);
}

TEST(ComparePixels, TakesOtherLimits) {
  Image other = scene();
  for (int x = 100; x < 112; ++x) channel(other, x, 10, 2) ^= 0x20;
  EXPECT_FALSE(compare_pixels(scene(), other).passed());
  EXPECT_TRUE(compare_pixels(scene(), other, {.cluster = 13}).passed());
  EXPECT_FALSE(compare_pixels(scene(), other, {.cluster = 12}).passed());
  EXPECT_FALSE(compare_pixels(scene(), other, {.cluster = 13, .total = 11}).passed());
  EXPECT_TRUE(compare_pixels(scene(), other, {.channel = 0x20}).passed());
  EXPECT_FALSE(compare_pixels(scene(), other, {.channel = 0x1F}).passed());
}

TEST(ComparePixels, JoinsADiagonalAcrossTheBorders) {
  Image diagonal = scene();
  for (int i = 0; i < 8; ++i) channel(diagonal, 239 - i, i, 0) ^= 0x80;
  const PixelComparison result = compare_pixels(scene(), diagonal);
  EXPECT_EQ(result.largest_cluster, 8);
  EXPECT_EQ(result.largest_cluster_at, (PixelBox{232, 0, 240, 8}));
}

TEST(DifferenceImage, ShowsDifferencesInVermilionOverAGhostWithAFrame) {
  Image actual = scene();
  paint_dot(actual, 30, 100, 4, {0, 0, 0});
  const Image shown = difference_image(scene(), actual);
  ASSERT_EQ(shown.width, 240);
  ASSERT_EQ(shown.height, 160);
  const auto pixel = [&shown](int x, int y) {
    const std::uint8_t* p = &shown.rgb[3 * static_cast<std::size_t>(y * shown.width + x)];
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  EXPECT_THAT(pixel(30, 100), ::testing::ElementsAre(0xD5, 0x5E, 0x00));
  EXPECT_THAT(pixel(5, 5), ::testing::ElementsAre(255, 255, 255));
  EXPECT_THAT(pixel(150, 60),
              ::testing::Each(::testing::AllOf(::testing::Ge(170), ::testing::Lt(255))));
  const PixelBox box = compare_pixels(scene(), actual).largest_cluster_at;
  EXPECT_THAT(pixel(box.left - 5, box.top - 5), ::testing::ElementsAre(0x00, 0x72, 0xB2));
}

TEST(DifferenceImage, CoversBothPicturesWhereSizesDiffer) {
  const Image shown = difference_image(Image(10, 30), Image(20, 8));
  EXPECT_EQ(shown.width, 20);
  EXPECT_EQ(shown.height, 30);
}

}  // namespace
}  // namespace contactscope

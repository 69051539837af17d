// Compares painted text with the glyph bitmaps of image/font.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gl/painting.h"
#include "image/font.h"

namespace contactscope::gl {
namespace {

using draw::Align;
using draw::Text;
using testing::ink;
using testing::paint;
using testing::pixel;

constexpr draw::Color kBlack{0, 0, 0, 1};

class TextTest : public ::testing::Test {
 protected:
  std::unique_ptr<Context> context_ = open_context(Backend::Auto);
};

/// First and last column with ink, and first and last row.
struct Extent {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

Extent extent_of(const Image& image) {
  Extent extent;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (pixel(image, x, y)[0] == 255) continue;
      extent.left = std::min(extent.left, x);
      extent.right = std::max(extent.right, x);
      extent.top = std::min(extent.top, y);
      extent.bottom = std::max(extent.bottom, y);
    }
  }
  return extent;
}

TEST_F(TextTest, PixelsEqualTheGlyphsCoverage) {
  for (const float x : {20.0f, 20.25f, 20.5f, 20.75f}) {
    for (const char32_t code : {U'g', U'8', U'M'}) {
      const Image image =
          paint(*context_, 64, 64, {Text{{static_cast<char>(code)}, {x, 40}, 24, {}, {}, kBlack}});
      const GlyphBitmap glyph = rasterize_glyph(code, 24, FontWeight::Regular, x - 20, 0);
      for (int py = 0; py < 64; ++py) {
        for (int px = 0; px < 64; ++px) {
          const int column = px - 20 - glyph.left, row = py - 40 - glyph.top;
          const bool inside = column >= 0 && row >= 0 && column < glyph.width && row < glyph.height;
          const int coverage =
              inside ? glyph.coverage[static_cast<std::size_t>(row * glyph.width + column)] : 0;
          ASSERT_NEAR(pixel(image, px, py)[0], 255 - coverage, 1) << px << ", " << py;
        }
      }
    }
  }
}

TEST_F(TextTest, BaselineIsOnAWholeRowAndThePenOnQuarters) {
  const auto painted = [this](float x, float y) {
    return paint(*context_, 120, 40, {Text{"0.125 mm", {x, y}, 15, {}, {}, kBlack}});
  };
  EXPECT_EQ(painted(10, 20.4f), painted(10, 20));
  EXPECT_EQ(painted(10.1f, 20), painted(10, 20));
  EXPECT_NE(painted(10.2f, 20), painted(10, 20));
  EXPECT_NE(painted(10, 20.6f), painted(10, 20));
}

TEST_F(TextTest, AlignmentPutsTheAnchorAtLeftMiddleAndRight) {
  const float width = text_width("HHHH", 20, FontWeight::Bold);
  for (const auto& [align, left] : {std::pair{Align::Left, 100.0f},
                                    {Align::Center, 100 - width / 2},
                                    {Align::Right, 100 - width}}) {
    const Image image =
        paint(*context_, 200, 40, {Text{"HHHH", {100, 30}, 20, draw::Weight::Bold, align, kBlack}});
    const Extent extent = extent_of(image);
    EXPECT_NEAR(extent.left, left + 1, 1.5);
    EXPECT_NEAR(extent.right, left + width - 2, 1.5);
    EXPECT_EQ(extent.bottom, 29) << "the baseline is the lower edge of row 29";
  }
}

TEST_F(TextTest, HaloLiesBelowAllLettersOfItsRun) {
  Text text{"WAWAW", {20, 40}, 24, {}, {}, kBlack};
  const Image plain = paint(*context_, 160, 60, {text});
  text.halo = 4;
  text.halo_color = {1, 1, 1, 1};
  const Image with_halo = paint(*context_, 160, 60, {text});
  EXPECT_EQ(with_halo, plain) << "a white halo on white changes no letter";
  const draw::Fill grey{{{0, 0}, {160, 0}, {160, 60}, {0, 60}}, {0.5f, 0.5f, 0.5f, 1}};
  const Image on_grey = paint(*context_, 160, 60, {grey, text});
  const Extent letters = extent_of(plain);
  EXPECT_EQ(pixel(on_grey, letters.left - 2, letters.top + 1)[0], 255)
      << "white beside the letters";
  EXPECT_NEAR(pixel(on_grey, letters.left - 9, letters.top + 1)[0], 128, 1) << "grey further out";
}

TEST_F(TextTest, BrokenUtf8ShowsReplacementsAndDoesNoHarm) {
  const Image broken = paint(*context_, 100, 40,
                             {Text{"a\xFF"
                                   "b",
                                   {10, 30},
                                   20,
                                   {},
                                   {},
                                   kBlack}});
  const Image replaced = paint(*context_, 100, 40,
                               {Text{"a\uFFFD"
                                     "b",
                                     {10, 30},
                                     20,
                                     {},
                                     {},
                                     kBlack}});
  EXPECT_EQ(broken, replaced);
  EXPECT_GT(ink(broken), 0);
}

TEST_F(TextTest, HundredsOfSizesFillMoreThanOnePageOfTheAtlas) {
  Rasterizer rasterizer(*context_, 1200, 60);
  draw::Drawing drawing;
  for (int i = 0; i < 40; ++i) {
    drawing.primitives.clear();
    drawing.primitives.push_back(Text{"separation of the two hulls",
                                      {5, 45},
                                      30 + 0.37f * static_cast<float>(i),
                                      {},
                                      {},
                                      kBlack,
                                      2,
                                      {1, 1, 1, 1}});
    const Image crowded = paint(rasterizer, drawing);
    if (i % 13 == 0) {
      EXPECT_EQ(paint(*context_, 1200, 60, drawing.primitives), crowded) << i;
    }
  }
}

}  // namespace
}  // namespace contactscope::gl

#include "gl/rasterizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "gl/painting.h"
#include "gl/sample_drawing.h"

namespace contactscope::gl {
namespace {

using draw::Color;
using draw::Fill;
using ::testing::ElementsAre;
using testing::ink;
using testing::paint;
using testing::Pixel;
using testing::pixel;

class RasterizerTest : public ::testing::Test {
 protected:
  std::unique_ptr<Context> context_ = open_context(Backend::Auto);
};

Color hex(unsigned rgb, float alpha = 1) {
  return {static_cast<float>(rgb >> 16) / 255, static_cast<float>(rgb >> 8 & 255) / 255,
          static_cast<float>(rgb & 255) / 255, alpha};
}

Fill rectangle(float left, float top, float right, float bottom, const Color& color) {
  return {{{left, top}, {right, top}, {right, bottom}, {left, bottom}}, color};
}

draw::Text text(const std::string& words, const draw::Point2& at) {
  draw::Text out;
  out.text = words;
  out.at = at;
  return out;
}

TEST_F(RasterizerTest, BackgroundAndOpaqueFillsHaveExactlyTheirHexCodes) {
  Rasterizer rasterizer(*context_, 32, 16);
  for (const unsigned code : {0xDDE3EAu, 0xEDE6DAu, 0x0072B2u, 0x56B4E9u, 0xE69F00u, 0x009E73u,
                              0xD55E00u, 0x666666u, 0xCC79A7u, 0x000000u, 0xFFFFFFu, 0x010203u}) {
    draw::Drawing drawing;
    drawing.background = hex(code);
    drawing.primitives = {rectangle(8, 4, 24, 12, hex(code ^ 0xFFFFFF))};
    const Image image = paint(rasterizer, drawing);
    const auto expected = [](unsigned rgb) {
      return Pixel{static_cast<int>(rgb >> 16), static_cast<int>(rgb >> 8 & 255),
                   static_cast<int>(rgb & 255)};
    };
    EXPECT_EQ(pixel(image, 2, 2), expected(code));
    EXPECT_EQ(pixel(image, 16, 8), expected(code ^ 0xFFFFFF));
  }
}

TEST_F(RasterizerTest, ATransparentPictureComesOutRightOverAnyGround) {
  Rasterizer rasterizer(*context_, 64, 48);
  draw::Drawing drawing;
  drawing.primitives = {rectangle(4, 4, 30, 30, hex(0x0072B2, 0.35f)),
                        rectangle(20, 20, 60, 44, hex(0xD55E00, 0.5f)),
                        draw::Stroke{{3, 45}, {60, 5}, 3, hex(0x1A1D21), draw::Cap::Round},
                        draw::Disc{{40, 14}, 0, 7, hex(0x009E73, 0.8f)}};
  drawing.background = {1, 1, 1, 0};
  const Image clear = paint(rasterizer, drawing);
  ASSERT_EQ(clear.alpha.size(), 64u * 48u);
  EXPECT_EQ(int(clear.alpha[0]), 0);
  for (const unsigned ground : {0xFFFFFFu, 0x14171Au, 0x56B4E9u}) {
    drawing.background = hex(ground);
    const Image solid = paint(rasterizer, drawing);
    EXPECT_TRUE(solid.alpha.empty());
    int worst = 0;
    for (std::size_t i = 0; i < solid.rgb.size(); ++i) {
      const double alpha = clear.alpha[i / 3] / 255.0;
      const double beneath = ground >> (16 - 8 * (i % 3)) & 255;
      const double over = alpha * clear.rgb[i] + (1 - alpha) * beneath;
      worst = std::max(worst, static_cast<int>(std::abs(over - solid.rgb[i])));
    }
    EXPECT_LE(worst, 3) << "each of four layers rounds to 8 bits once";
  }
}

TEST_F(RasterizerTest, ReadsTheTopRowFirst) {
  const Image image =
      paint(*context_, 20, 10,
            {rectangle(0, 0, 20, 2, hex(0xFF0000)), rectangle(0, 0, 3, 10, hex(0x0000FF))});
  EXPECT_THAT(pixel(image, 10, 0), ElementsAre(255, 0, 0));
  EXPECT_THAT(pixel(image, 10, 1), ElementsAre(255, 0, 0));
  EXPECT_THAT(pixel(image, 10, 2), ElementsAre(255, 255, 255));
  EXPECT_THAT(pixel(image, 10, 9), ElementsAre(255, 255, 255));
  EXPECT_THAT(pixel(image, 2, 9), ElementsAre(0, 0, 255));
  EXPECT_THAT(pixel(image, 3, 9), ElementsAre(255, 255, 255));
}

TEST_F(RasterizerTest, LaterPrimitivesCoverEarlierOnes) {
  const Fill red = rectangle(0, 0, 8, 8, hex(0xFF0000)),
             blue = rectangle(0, 0, 8, 8, hex(0x0000FF));
  EXPECT_THAT(pixel(paint(*context_, 8, 8, {red, blue}), 4, 4), ElementsAre(0, 0, 255));
  EXPECT_THAT(pixel(paint(*context_, 8, 8, {blue, red}), 4, 4), ElementsAre(255, 0, 0));
}

TEST_F(RasterizerTest, TranslucencyMixesBytesInPaintersOrder) {
  const Fill blue = rectangle(0, 0, 8, 8, hex(0x0072B2, 0.35f));
  const Fill orange = rectangle(0, 0, 8, 8, hex(0xE69F00, 0.35f));
  const auto over = [](const Pixel& below, const Pixel& color) {
    Pixel mixed{};
    for (std::size_t c = 0; c < 3; ++c) {
      mixed[c] = static_cast<int>(std::lround(0.35 * color[c] + 0.65 * below[c]));
    }
    return mixed;
  };
  const auto expect_near = [](const Pixel& actual, const Pixel& expected) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], 1);
  };
  const Pixel white{255, 255, 255}, blue_bytes{0, 0x72, 0xB2}, orange_bytes{0xE6, 0x9F, 0};
  expect_near(pixel(paint(*context_, 8, 8, {blue}), 4, 4), over(white, blue_bytes));
  expect_near(pixel(paint(*context_, 8, 8, {blue, orange}), 4, 4),
              over(over(white, blue_bytes), orange_bytes));
  expect_near(pixel(paint(*context_, 8, 8, {orange, blue}), 4, 4),
              over(over(white, orange_bytes), blue_bytes));
}

TEST_F(RasterizerTest, NeighbouringFillsShareAnEdgeWithoutGapOrOverlap) {
  // A fan of translucent triangles around a point: each pixel belongs to one of them.
  std::vector<draw::Primitive> fan;
  const draw::Point2 center{50.3f, 49.6f};
  const auto rim = [&center](int i) {
    const double angle = 6.283185307 * (i % 7) / 7;
    return draw::Point2{center.x + 90 * static_cast<float>(std::cos(angle)),
                        center.y + 90 * static_cast<float>(std::sin(angle))};
  };
  for (int i = 0; i < 7; ++i) fan.push_back(Fill{{center, rim(i), rim(i + 1)}, {0, 0, 0, 0.5f}});
  const Image image = paint(*context_, 100, 100, fan);
  const int half = pixel(image, 50, 20)[0];
  EXPECT_NEAR(half, 127.5, 1);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) ASSERT_EQ(pixel(image, x, y)[0], half) << x << ", " << y;
  }
}

TEST_F(RasterizerTest, FillsOfEitherWindingHaveTheirArea) {
  Fill hexagon;
  hexagon.color = {0, 0, 0, 1};
  for (int i = 0; i < 6; ++i) {
    const double angle = 0.2 + 6.283185307 * i / 6;
    hexagon.polygon.push_back({60.0f + 50 * static_cast<float>(std::cos(angle)),
                               60.0f + 50 * static_cast<float>(std::sin(angle))});
  }
  const double area = 1.5 * std::sqrt(3.0) * 50 * 50;
  EXPECT_NEAR(ink(paint(*context_, 120, 120, {hexagon})), area, 0.005 * area);
  std::reverse(hexagon.polygon.begin(), hexagon.polygon.end());
  EXPECT_NEAR(ink(paint(*context_, 120, 120, {hexagon})), area, 0.005 * area);
}

TEST_F(RasterizerTest, PrimitivesWithoutAreaPaintNothing) {
  const Color black{0, 0, 0, 1};
  const Image image =
      paint(*context_, 40, 40,
            {Fill{{}, black}, Fill{{{1, 1}, {30, 30}}, black},
             draw::Stroke{{5, 5}, {5, 5}, 4, black}, draw::Stroke{{5, 5}, {30, 5}, 0, black},
             draw::Disc{{20, 20}, 0, 0, black}, draw::Disc{{20, 20}, 5, 5, black},
             text("", {10, 10}), text("  ", {10, 10}), text("far away", {4000, -9000})});
  EXPECT_EQ(ink(image), 0);
}

TEST_F(RasterizerTest, PaintsTwoSizesInTurnsAndCutsAtTheBorder) {
  Rasterizer small(*context_, 61, 37), large(*context_, 200, 150);
  const draw::Drawing drawing = testing::sample_drawing(61, 37);
  const Image first = paint(small, drawing), wide = paint(large, drawing);
  ASSERT_EQ(first.width, 61);
  ASSERT_EQ(first.height, 37);
  for (int y = 0; y < 37; ++y) {
    for (int x = 0; x < 61; ++x) ASSERT_EQ(pixel(first, x, y), pixel(wide, x, y));
  }
  EXPECT_EQ(paint(small, drawing), first);
}

TEST_F(RasterizerTest, APictureForgetsTheLastFrame) {
  Rasterizer rasterizer(*context_, 64, 64);
  const Image before = paint(rasterizer, draw::Drawing{});
  paint(rasterizer, testing::sample_drawing(64, 64));
  EXPECT_EQ(paint(rasterizer, draw::Drawing{}), before);
}

TEST_F(RasterizerTest, FramebufferIsOneOfItsOwn) {
  Rasterizer first(*context_, 64, 64), second(*context_, 64, 64);
  const Image expected = paint(first, testing::sample_drawing(64, 64));
  EXPECT_NE(paint(second, draw::Drawing{}), expected);
  EXPECT_EQ(first.read(), expected);
}

TEST_F(RasterizerTest, RefusesSizesThatNoPictureHas) {
  EXPECT_THROW(Rasterizer(*context_, 0, 10), std::invalid_argument);
  EXPECT_THROW(Rasterizer(*context_, 10, -1), std::invalid_argument);
  EXPECT_THROW(Rasterizer(*context_, 1 << 20, 1 << 20), std::runtime_error);
}

}  // namespace
}  // namespace contactscope::gl

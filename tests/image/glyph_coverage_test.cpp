#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include "image/font.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;

TEST(GlyphCoverage, IsTheShareOfAPixelThatARectangleCovers) {
  const Contour box{{0.5, 0.25}, {2.5, 0.25}, {2.5, 1}, {0.5, 1}};
  EXPECT_THAT(coverage_of({box}, 3, 2), ElementsAre(96, 191, 96, 0, 0, 0));
}

TEST(GlyphCoverage, WindingDoesNotMatterAndContoursOfTheOtherOneAreHoles) {
  const Contour outer{{0, 0}, {3, 0}, {3, 3}, {0, 3}}, inner{{1, 1}, {1, 2}, {2, 2}, {2, 1}};
  EXPECT_THAT(coverage_of({outer, inner}, 3, 3),
              ElementsAre(255, 255, 255, 255, 0, 255, 255, 255, 255));
  EXPECT_EQ(coverage_of({Contour(outer.rbegin(), outer.rend())}, 3, 3), coverage_of({outer}, 3, 3));
}

TEST(GlyphCoverage, SlantedEdgesCoverTrianglesAndTrapezoids) {
  // From the upper left corner to the lower right one, one pixel down for two to the right.
  const Contour triangle{{0, 0}, {4, 2}, {0, 2}};
  EXPECT_THAT(coverage_of({triangle}, 4, 2), ElementsAre(191, 64, 0, 0, 255, 255, 191, 64));
}

TEST(GlyphCoverage, SumsUpToTheAreaOfAnyPolygon) {
  constexpr int kSide = 40;
  for (const int corners : {3, 5, 17, 200}) {
    Contour polygon;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners + 0.1;
      polygon.push_back({20.3 + 17 * std::cos(angle), 19.8 + 17 * std::sin(angle)});
    }
    const double area = 0.5 * corners * 17 * 17 * std::sin(2 * std::numbers::pi / corners);
    const std::vector<std::uint8_t> pixels = coverage_of({polygon}, kSide, kSide);
    EXPECT_NEAR(std::accumulate(pixels.begin(), pixels.end(), 0.0) / 255, area, 2e-3 * area);
  }
}

/// Fowler, Noll and Vo 1991, the variant 1a.
std::uint64_t hashed(const GlyphBitmap& glyph, std::uint64_t hash) {
  const auto mix = [&hash](std::uint64_t byte) { hash = (hash ^ byte) * 0x100000001B3ull; };
  for (const int number : {glyph.width, glyph.height, glyph.left, glyph.top})
    mix(static_cast<std::uint8_t>(number));
  for (const std::uint8_t pixel : glyph.coverage) mix(pixel);
  return hash;
}

// Stored pictures contain text: a letter that differs anywhere would fail all of them.
TEST(GlyphCoverage, LettersHaveTheSamePixelsEverywhere) {
  std::uint64_t hash = 0xCBF29CE484222325ull;
  for (const FontWeight weight : {FontWeight::Regular, FontWeight::Bold}) {
    for (const float size : {10.08f, 14.0f, 15.0f, 16.0f, 28.0f}) {
      for (char32_t code = 0x20; code < 0x180; ++code)
        hash = hashed(rasterize_glyph(code, size, weight, 0.25f, 0), hash);
      for (const char32_t code : U"\u2212\u00B2\u2264\u2026\u207B\u2076\u2013")
        hash = hashed(rasterize_glyph(code, size, weight, 0.5f, 2), hash);
    }
  }
  EXPECT_EQ(hash, 0x50FA86E3658CF91Dull);
}

}  // namespace
}  // namespace contactscope

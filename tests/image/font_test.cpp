#include "image/font.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "image/encoding.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;

constexpr FontWeight kBoth[] = {FontWeight::Regular, FontWeight::Bold};

double total(const GlyphBitmap& glyph) {
  return std::accumulate(glyph.coverage.begin(), glyph.coverage.end(), 0.0) / 255;
}

/// Coverage at a place relative to the pen; 0 outside the bitmap.
int at(const GlyphBitmap& glyph, int x, int y) {
  const int column = x - glyph.left, row = y - glyph.top;
  if (column < 0 || row < 0 || column >= glyph.width || row >= glyph.height) return 0;
  return glyph.coverage[static_cast<std::size_t>(row * glyph.width + column)];
}

TEST(Utf8, DecodesOneToFourBytes) {
  EXPECT_THAT(code_points("a\u00D7\u2212\U0001F600"), ElementsAre(U'a', 0xD7, 0x2212, 0x1F600));
  EXPECT_THAT(code_points(""), ElementsAre());
}

TEST(Utf8, TurnsEachBrokenByteIntoAReplacement) {
  EXPECT_THAT(code_points("a\xFFz"), ElementsAre(U'a', 0xFFFD, U'z'));
  EXPECT_THAT(code_points("\xC3"), ElementsAre(0xFFFD)) << "cut short";
  EXPECT_THAT(code_points("\xC0\xAF"), ElementsAre(0xFFFD, 0xFFFD)) << "overlong";
  EXPECT_THAT(code_points("\xE0\x80\xAF"), ElementsAre(0xFFFD, 0xFFFD, 0xFFFD)) << "overlong";
  EXPECT_THAT(code_points("\xED\xA0\x80"), ElementsAre(0xFFFD, 0xFFFD, 0xFFFD)) << "surrogate";
  EXPECT_THAT(code_points("\xF4\x90\x80\x80"), ElementsAre(0xFFFD, 0xFFFD, 0xFFFD, 0xFFFD));
  EXPECT_THAT(code_points("\xC3("), ElementsAre(0xFFFD, U'('));
}

TEST(Font, HasTheSignsThatLabelsUse) {
  for (const FontWeight weight : kBoth) {
    for (const char32_t code : U"Ag0\u2212\u00D7\u00B0\u00B7\u00B2\u00B5\u03BC\u2264\u2265\u2026") {
      if (code == 0) continue;  // the literal's end
      EXPECT_TRUE(has_glyph(code, weight)) << std::hex << static_cast<unsigned>(code);
    }
    EXPECT_FALSE(has_glyph(0x4E00, weight)) << "no Chinese in Roboto";
  }
}

TEST(Font, SizeRunsFromAscenderToDescender) {
  for (const FontWeight weight : kBoth) {
    for (const float size : {14.0f, 28.0f}) {
      EXPECT_NEAR(ascent(size, weight) + descent(size, weight), size, 1e-4);
      EXPECT_GT(ascent(size, weight), 2 * descent(size, weight));
    }
  }
}

TEST(Font, DigitsAndSignsAreTabular) {
  for (const FontWeight weight : kBoth) {
    const float zero = advance(U'0', 14, weight);
    for (char32_t digit = U'1'; digit <= U'9'; ++digit) {
      EXPECT_EQ(advance(digit, 14, weight), zero);
    }
    EXPECT_NEAR(text_width("0.120", 14, weight), 4 * zero + advance(U'.', 14, weight), 1e-4);
  }
}

TEST(Font, WidthGrowsInProportionToSize) {
  const float small = text_width("separation \u22120.005 m", 10, FontWeight::Regular);
  EXPECT_NEAR(text_width("separation \u22120.005 m", 30, FontWeight::Regular), 3 * small, 1e-3);
  EXPECT_GT(text_width("separation", 10, FontWeight::Bold),
            text_width("separation", 10, FontWeight::Regular));
}

TEST(Glyph, LetterStandsOnTheBaselineRightOfThePen) {
  const GlyphBitmap glyph = rasterize_glyph(U'H', 32, FontWeight::Regular, 0, 0);
  ASSERT_GT(glyph.width, 5);
  EXPECT_EQ(glyph.top + glyph.height, 0) << "no descender";
  EXPECT_GE(glyph.left, 0);
  EXPECT_LE(glyph.left + glyph.width, std::ceil(advance(U'H', 32, FontWeight::Regular)));
  // Two stems with nothing between them above the bar.
  const int row = glyph.top + 2;
  EXPECT_EQ(at(glyph, glyph.left + glyph.width / 2, row), 0);
  EXPECT_GT(at(glyph, glyph.left + 2, row), 200);
}

TEST(Glyph, DescenderHangsBelowTheBaseline) {
  const GlyphBitmap glyph = rasterize_glyph(U'g', 32, FontWeight::Regular, 0, 0);
  EXPECT_GT(glyph.top + glyph.height, 3);
}

TEST(Glyph, SpaceHasNoPixels) {
  const GlyphBitmap glyph = rasterize_glyph(U' ', 14, FontWeight::Regular, 0.25f, 2);
  EXPECT_EQ(glyph.width, 0);
  EXPECT_TRUE(glyph.coverage.empty());
}

TEST(Glyph, SubpixelShiftMovesTheInkAndKeepsItsAmount) {
  const auto centroid = [](const GlyphBitmap& glyph) {
    double sum = 0;
    for (int y = 0; y < glyph.height; ++y) {
      for (int x = 0; x < glyph.width; ++x) {
        sum += (glyph.left + x + 0.5) * at(glyph, glyph.left + x, glyph.top + y) / 255;
      }
    }
    return sum / total(glyph);
  };
  const GlyphBitmap still = rasterize_glyph(U'8', 16, FontWeight::Regular, 0, 0);
  for (const float shift : {0.25f, 0.5f, 0.75f}) {
    const GlyphBitmap moved = rasterize_glyph(U'8', 16, FontWeight::Regular, shift, 0);
    EXPECT_NEAR(centroid(moved) - centroid(still), shift, 0.02);
    EXPECT_NEAR(total(moved), total(still), 0.01 * total(still));
  }
}

TEST(Glyph, HaloOfAFullStopAddsItsPerimeterAndRoundCorners) {
  // The dot of a large full stop is a square: growing it by r adds its perimeter times r and the
  // quarter discs at the corners.
  const GlyphBitmap letter = rasterize_glyph(U'.', 60, FontWeight::Bold, 0, 0);
  const GlyphBitmap halo = rasterize_glyph(U'.', 60, FontWeight::Bold, 0, 4);
  const double side = std::sqrt(total(letter));
  const double expected = side * side + 4 * side * 4 + 3.14159265 * 4 * 4;
  EXPECT_NEAR(total(halo), expected, 0.06 * expected);
}

TEST(Glyph, HaloCoversTheLetterAndFadesOutAtItsWidth) {
  const GlyphBitmap letter = rasterize_glyph(U'k', 20, FontWeight::Regular, 0.5f, 0);
  const GlyphBitmap halo = rasterize_glyph(U'k', 20, FontWeight::Regular, 0.5f, 2.5f);
  for (int y = halo.top; y < halo.top + halo.height; ++y) {
    for (int x = halo.left; x < halo.left + halo.width; ++x) {
      EXPECT_GE(at(halo, x, y), at(letter, x, y));
      double nearest = 1e9;
      for (int ly = letter.top; ly < letter.top + letter.height; ++ly) {
        for (int lx = letter.left; lx < letter.left + letter.width; ++lx) {
          if (at(letter, lx, ly) > 0) nearest = std::min(nearest, std::hypot(lx - x, ly - y));
        }
      }
      if (nearest >= 3.5) {
        EXPECT_EQ(at(halo, x, y), 0) << x << ", " << y;
      }
    }
  }
}

TEST(Font, AQuestionMarkStandsForWhatNoFontHas) {
  constexpr char32_t kBox = 0x7BB1;
  EXPECT_EQ(font_for(kBox, FontWeight::Regular), 0u);
  EXPECT_FALSE(has_glyph(kBox, FontWeight::Regular));
  EXPECT_EQ(advance(kBox, 14, FontWeight::Regular), advance(U'?', 14, FontWeight::Regular));
  EXPECT_EQ(rasterize_glyph(kBox, 14, FontWeight::Bold, 0, 0).coverage,
            rasterize_glyph(U'?', 14, FontWeight::Bold, 0, 0).coverage);
}

TEST(Font, TheEmbeddedOneComesFirst) {
  const std::string path = ::testing::TempDir() + "added.ttf";
  const auto data = font_data(FontWeight::Bold);
  write_whole_file(path, data);
  const float before = text_width("face contact", 14, FontWeight::Regular);
  add_font(path);
  EXPECT_EQ(text_width("face contact", 14, FontWeight::Regular), before);
  EXPECT_EQ(font_for(U'a', FontWeight::Regular), 0u);
  EXPECT_EQ(font_data(FontWeight::Regular, 1).size(), data.size());
}

TEST(Font, AnInvalidFontIsRefusedAndDropped) {
  const std::string path = ::testing::TempDir() + "none.ttf";
  const std::string text = "this is a text and no font at all";
  write_whole_file(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  EXPECT_THROW(add_font(path), FontError);
  EXPECT_EQ(font_for(0x7BB1, FontWeight::Regular), 0u);
}

TEST(Font, AnEmIsSmallerThanALine) {
  // Roboto's ascender and descender are 1900 and 500 of 2048.
  EXPECT_NEAR(line_of_em(FontWeight::Regular), 2400.0 / 2048, 1e-4);
}

}  // namespace
}  // namespace contactscope

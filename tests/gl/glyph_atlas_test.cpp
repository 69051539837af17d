#include "gl/primitive_vertices.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace contactscope::gl {
namespace {

TEST(GlyphAtlas, PlacesNeverOverlapAndHoldTheirBitmaps) {
  GlyphAtlas atlas;
  std::vector<std::pair<GlyphKey, GlyphPlace>> stored;
  for (const float size : {14.0f, 61.0f, 28.0f, 170.0f}) {
    for (char32_t code = U'!'; code < 127; ++code) {
      const GlyphKey key{code, size, FontWeight::Regular, static_cast<int>(code % 4),
                         static_cast<float>(code % 3)};
      stored.emplace_back(key, atlas.find(key));
    }
  }
  EXPECT_GT(atlas.pages().size(), 1u);
  std::vector<std::vector<int>> owner(
      atlas.pages().size(),
      std::vector<int>(static_cast<std::size_t>(GlyphAtlas::kSide) * GlyphAtlas::kSide, -1));
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const auto& [key, place] = stored[i];
    const GlyphBitmap bitmap = rasterize_glyph(key.code_point, key.size, key.weight,
                                               static_cast<float>(key.quarter) / 4, key.halo);
    ASSERT_EQ(place.width, bitmap.width);
    ASSERT_EQ(place.height, bitmap.height);
    const std::size_t page = static_cast<std::size_t>(place.page);
    for (int y = 0; y < place.height; ++y) {
      for (int x = 0; x < place.width; ++x) {
        const std::size_t at = static_cast<std::size_t>(place.y + y) * GlyphAtlas::kSide +
                               static_cast<std::size_t>(place.x + x);
        ASSERT_EQ(owner[page][at], -1);
        owner[page][at] = static_cast<int>(i);
        ASSERT_EQ(atlas.pages()[page].coverage[at],
                  bitmap.coverage[static_cast<std::size_t>(y * bitmap.width + x)]);
      }
    }
  }
}

TEST(GlyphAtlas, ASecondLookupGivesTheSamePlaceAndNoChange) {
  GlyphAtlas atlas;
  const GlyphKey key{U'g', 20, FontWeight::Bold, 1, 2};
  const GlyphPlace first = atlas.find(key);
  ASSERT_EQ(atlas.pages().size(), 1u);
  GlyphAtlas::Page& page = atlas.pages().front();
  EXPECT_LE(page.changed_from, first.y);
  EXPECT_GE(page.changed_to, first.y + first.height);
  page.changed_from = page.changed_to = 0;
  const GlyphPlace again = atlas.find(key);
  EXPECT_EQ(again.x, first.x);
  EXPECT_EQ(again.y, first.y);
  EXPECT_EQ(page.changed_to, 0);
  const GlyphPlace other = atlas.find({U'g', 20, FontWeight::Bold, 2, 2});
  EXPECT_NE(other.x, first.x);
  EXPECT_GT(page.changed_to, 0);
}

TEST(GlyphAtlas, ASpaceTakesNoRoom) {
  GlyphAtlas atlas;
  EXPECT_EQ(atlas.find({U' ', 20, FontWeight::Regular, 0, 3}).width, 0);
  EXPECT_TRUE(atlas.pages().empty());
}

TEST(GlyphAtlas, AGlyphLargerThanAPageIsAnError) {
  GlyphAtlas atlas;
  EXPECT_THROW(atlas.find({U'W', 3000, FontWeight::Bold, 0, 0}), std::length_error);
}

}  // namespace
}  // namespace contactscope::gl

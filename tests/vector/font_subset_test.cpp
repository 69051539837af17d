#include "vector/font_subset.h"

#include <gmock/gmock.h>

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

namespace contactscope::vector {
namespace {

struct Font {
  std::string file;
  stbtt_fontinfo info{};

  explicit Font(std::string bytes) : file(std::move(bytes)) {
    const auto* data = reinterpret_cast<const unsigned char*>(file.data());
    readable = stbtt_InitFont(&info, data, stbtt_GetFontOffsetForIndex(data, 0)) != 0;
  }
  bool has(char32_t code) const {
    const int glyph = stbtt_FindGlyphIndex(&info, static_cast<int>(code));
    return glyph != 0 && stbtt_IsGlyphEmpty(&info, glyph) == 0;
  }
  float advance_of(char32_t code, float size) const {
    int advance = 0, left = 0;
    stbtt_GetCodepointHMetrics(&info, static_cast<int>(code), &advance, &left);
    return static_cast<float>(advance) * stbtt_ScaleForPixelHeight(&info, size);
  }

  bool readable = false;
};

TEST(FontSubset, HoldsTheGivenLettersAndNoOthers) {
  for (const FontWeight weight : {FontWeight::Regular, FontWeight::Bold}) {
    const Font font(font_subset({weight, 0}, {U'a', U'7', U'²', U'−'}));
    ASSERT_TRUE(font.readable);
    for (const char32_t code : {U'a', U'7', U'²', U'−'})
      EXPECT_TRUE(font.has(code)) << static_cast<unsigned>(code);
    for (const char32_t code : {U'b', U'8', U'A', U'½'})
      EXPECT_FALSE(font.has(code)) << static_cast<unsigned>(code);
    EXPECT_LT(font.info.numGlyphs, 8);
    // Texts have the width and height of their layout.
    EXPECT_NEAR(font.advance_of(U'7', 20), advance(U'7', 20, weight), 1e-3);
    EXPECT_LT(font.file.size(), 4000u);
  }
}

TEST(FontSubset, HasNoKerning) {
  const Font font(font_subset({FontWeight::Regular, 0}, {U'A', U'V'}));
  ASSERT_TRUE(font.readable);
  EXPECT_EQ(stbtt_GetCodepointKernAdvance(&font.info, 'A', 'V'), 0);
  EXPECT_EQ(font.info.gpos, 0);
}

TEST(FontSubset, EqualSetsGiveEqualBytes) {
  const std::set<char32_t> some = {U'x', U'y', U'0'};
  EXPECT_EQ(font_subset({FontWeight::Bold, 0}, some), font_subset({FontWeight::Bold, 0}, some));
  EXPECT_NE(font_subset({FontWeight::Bold, 0}, some), font_subset({FontWeight::Regular, 0}, some));
}

TEST(FontFaces, HaveEachWeightThatIsUsed) {
  draw::Drawing drawing{.width = 10, .height = 10};
  drawing.primitives.push_back(draw::Text{"ab", {1, 1}});
  UsedCharacters used;
  add_characters(drawing, used);
  FontFaces faces;
  const std::string regular = faces.css(used);
  EXPECT_THAT(regular, testing::HasSubstr("font-weight:400"));
  EXPECT_THAT(regular, testing::Not(testing::HasSubstr("font-weight:700")));
  drawing.primitives.push_back(draw::Text{"c", {1, 1}, 14, draw::Weight::Bold});
  add_characters(drawing, used);
  EXPECT_THAT(faces.css(used), testing::HasSubstr("font-weight:700"));
  EXPECT_THAT((used[{FontWeight::Regular, 0}]), testing::ElementsAre(U'a', U'b'));
}

}  // namespace
}  // namespace contactscope::vector

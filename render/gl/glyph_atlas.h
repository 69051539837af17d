#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <vector>

#include "image/font.h"

namespace contactscope::gl {

/// What makes one bitmap of a glyph differ from another.
struct GlyphKey {
  char32_t code_point = 0;
  float size = 0;  // pixels
  FontWeight weight = FontWeight::Regular;
  int quarter = 0;  // pen at quarter / 4 pixels right of a pixel's left edge
  float halo = 0;   // pixels
  friend auto operator<=>(const GlyphKey&, const GlyphKey&) = default;
};

/// Where a glyph's bitmap lies in its page, and where it goes in the picture.
struct GlyphPlace {
  int page = 0;
  int x = 0, y = 0;           // of the bitmap's top left texel
  int width = 0, height = 0;  // 0 for a space
  int left = 0, top = 0;      // of the bitmap from the pen's pixel on the baseline
};

/// Coverage bitmaps of glyphs in square pages, rasterized when first asked for; never dropped, and
/// a page is added when one is full. No OpenGL here: the rasterizer copies changed rows to
/// textures.
class GlyphAtlas {
 public:
  static constexpr int kSide = 1024;

  struct Page {
    std::vector<std::uint8_t> coverage = std::vector<std::uint8_t>(kSide * kSide);  // from the top
    int changed_from = 0, changed_to = 0;  // rows that a texture has not seen yet
    int shelf_top = 0, shelf_height = 0, shelf_x = 0;
  };

  /// The place stays valid as long as the atlas. Throws std::length_error for a glyph larger than a
  /// page.
  const GlyphPlace& find(const GlyphKey& key);
  std::vector<Page>& pages() { return pages_; }

 private:
  GlyphPlace store(const GlyphBitmap& bitmap);

  std::vector<Page> pages_;
  std::map<GlyphKey, GlyphPlace> places_;
};

}  // namespace contactscope::gl

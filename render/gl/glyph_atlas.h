#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <vector>

#include "image/font.h"

namespace contactscope::gl {

/// Identifies a bitmap of a glyph.
struct GlyphKey {
  char32_t code_point = 0;
  float size = 0;  // pixels
  FontWeight weight = FontWeight::Regular;
  int quarter = 0;  // pen at quarter / 4 pixels right of a pixel's left edge
  float halo = 0;   // pixels
  friend auto operator<=>(const GlyphKey&, const GlyphKey&) = default;
};

/// Position of a glyph's bitmap in its page and relative to the pen.
struct GlyphPlace {
  int page = 0;
  int x = 0, y = 0;           // of the bitmap's top left texel
  int width = 0, height = 0;  // 0 for a space
  int left = 0, top = 0;      // of the bitmap, from the pen's pixel on the baseline
};

/// Coverage bitmaps of glyphs in square pages, rasterized on first use and never dropped. A page is
/// added when one is full. The rasterizer copies changed rows to OpenGL textures.
class GlyphAtlas {
 public:
  static constexpr int kSide = 1024;

  struct Page {
    std::vector<std::uint8_t> coverage = std::vector<std::uint8_t>(kSide * kSide);  // from the top
    int changed_from = 0, changed_to = 0;  // rows to upload to the texture
    int row_top = 0, row_height = 0, row_x = 0;
  };

  /// The result is valid as long as the atlas. Throws std::length_error if a glyph is larger than a
  /// page.
  const GlyphPlace& find(const GlyphKey& key);
  std::vector<Page>& pages() { return pages_; }

 private:
  GlyphPlace store(const GlyphBitmap& bitmap);

  std::vector<Page> pages_;
  std::map<GlyphKey, GlyphPlace> places_;
};

}  // namespace contactscope::gl

#pragma once

#include <compare>

#include "draw/scene/drawing.h"

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

/// A triangle corner; shaders/*.glsl document `line`, `form` and `run` for each program.
struct Vertex {
  float position[2];
  float line[4];
  float form[4];
  float run[3];
  std::array<std::uint8_t, 4> color;
};

enum class Painter { Fill, Shape, Glyph };

/// Consecutive triangles of one draw call.
struct Batch {
  Painter painter = Painter::Fill;
  int page = 0;                        // of the glyph atlas
  std::uint32_t first = 0, count = 0;  // indices
};

/// A drawing as triangles in painter's order.
struct PrimitiveVertices {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Batch> batches;

  GlyphAtlas atlas;

  /// Clears all except the atlas.
  void clear();
  /// Appends the triangles of a primitive: a fan for a fill, a quad for a stroke or disc, and two
  /// quads per glyph for text with a halo, all halos before all letters. Glyphs are on whole rows
  /// and quarter columns of pixels. Skips invisible primitives: no width, no length with butt caps,
  /// less than three corners. Coordinates must be finite.
  void append(const draw::Primitive& primitive);

 private:
  void add(const draw::Fill& fill);
  void add(const draw::Stroke& stroke);
  void add(const draw::Disc& disc);
  void add(const draw::Text& text);
  void add_glyph(const GlyphPlace& glyph, int pen_x, int baseline, const draw::Color& color);
  void add_polygon(Painter painter, int page, Vertex vertex, std::span<const draw::Point2> corners);
};

}  // namespace contactscope::gl

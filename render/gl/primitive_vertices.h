#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "draw/scene/drawing.h"
#include "gl/glyph_atlas.h"

namespace contactscope::gl {

/// One corner of a triangle; shaders.h says what each program makes of `line`, `form` and `run`.
struct Vertex {
  float position[2];
  float line[4];
  float form[4];
  float run[3];
  std::array<std::uint8_t, 4> color;
};

enum class Painter { Fill, Shape, Glyph };

/// Triangles in a row that one draw call paints.
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

  /// Forgets all but the atlas.
  void clear();
  /// Appends what a primitive consists of: a fan for a fill, one quad for a stroke or a disc, and
  /// two quads a glyph for text with a halo, all halos before all letters. Glyphs stand on whole
  /// rows and quarter columns of pixels. Appends nothing for what would not be seen: no width, no
  /// length with butt caps, less than three corners. Coordinates are finite.
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

#pragma once

#include <array>
#include <cstdint>
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

  void clear();
  /// Appends what a primitive consists of: a fan for a fill, one quad for a stroke or a disc, and
  /// two quads a glyph for text with a halo, all halos before all letters. Glyphs stand on whole
  /// rows and quarter columns of pixels. Appends nothing for what would not be seen: no width, no
  /// length with butt caps, less than three corners. Coordinates are finite.
  void append(const draw::Primitive& primitive, GlyphAtlas& atlas);

 private:
  void append_fill(const draw::Fill& fill);
  void append_stroke(const draw::Stroke& stroke);
  void append_disc(const draw::Disc& disc);
  void append_text(const draw::Text& text, GlyphAtlas& atlas);
  void append_glyph(const GlyphPlace& glyph, int pen_x, int baseline,
                    const std::array<std::uint8_t, 4>& color);
  void append_quad(Painter painter, int page, const Vertex& flat,
                   const std::array<draw::Point2, 4>& corners);
  void extend_batch(Painter painter, int page, std::uint32_t indices);
};

/// The colour as the framebuffer stores it: nearest of 256 steps a channel.
std::array<std::uint8_t, 4> to_bytes(const draw::Color& color);

}  // namespace contactscope::gl

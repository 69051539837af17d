#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "draw/scene/drawing.h"
#include "gl/glyph_atlas.h"

namespace contactscope::gl {

/// A triangle corner; shaders.h documents `line`, `form` and `run` for each program.
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

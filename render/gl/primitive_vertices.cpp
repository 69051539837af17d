#include "gl/primitive_vertices.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "image/font.h"

namespace contactscope::gl {
namespace {

using draw::Point2;

// A pixel whose centre is further than half a pixel's diagonal from a shape has no coverage. The
// rest is for the driver's own rounding of corners, to 1/256 of a pixel.
constexpr float kFringe = 0.7072f + 1.0f / 64;

[[maybe_unused]] bool finite(const Point2& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Corners of the rectangle that runs `back` behind `from`, `ahead` beyond it, and `side` to both
/// sides of `direction`.
std::array<Point2, 4> oriented_quad(const Point2& from, const Point2& direction, float back,
                                    float ahead, float side) {
  const auto corner = [&](float along, float across) {
    return Point2{from.x + along * direction.x - across * direction.y,
                  from.y + along * direction.y + across * direction.x};
  };
  return {corner(-back, -side), corner(ahead, -side), corner(ahead, side), corner(-back, side)};
}

float share_left_of_anchor(draw::Align align) {
  switch (align) {
    case draw::Align::Left:
      return 0;
    case draw::Align::Center:
      return 0.5f;
    case draw::Align::Right:
      return 1;
  }
  return 0;
}

}  // namespace

std::array<std::uint8_t, 4> to_bytes(const draw::Color& color) {
  const auto byte = [](float channel) {
    return static_cast<std::uint8_t>(std::clamp(channel, 0.0f, 1.0f) * 255 + 0.5f);
  };
  return {byte(color.r), byte(color.g), byte(color.b), byte(color.a)};
}

void PrimitiveVertices::clear() {
  vertices.clear();
  indices.clear();
  batches.clear();
}

void PrimitiveVertices::append(const draw::Primitive& primitive, GlyphAtlas& atlas) {
  if (const auto* fill = std::get_if<draw::Fill>(&primitive)) append_fill(*fill);
  if (const auto* stroke = std::get_if<draw::Stroke>(&primitive)) append_stroke(*stroke);
  if (const auto* disc = std::get_if<draw::Disc>(&primitive)) append_disc(*disc);
  if (const auto* text = std::get_if<draw::Text>(&primitive)) append_text(*text, atlas);
}

void PrimitiveVertices::append_fill(const draw::Fill& fill) {
  const std::size_t corners = fill.polygon.size();
  if (corners < 3) return;
  Vertex vertex{};
  vertex.color = to_bytes(fill.color);
  const std::uint32_t first = static_cast<std::uint32_t>(vertices.size());
  for (const Point2& corner : fill.polygon) {
    assert(finite(corner));
    vertex.position[0] = corner.x;
    vertex.position[1] = corner.y;
    vertices.push_back(vertex);
  }
  for (std::uint32_t i = 2; i < corners; ++i) {
    indices.insert(indices.end(), {first, first + i - 1, first + i});
  }
  extend_batch(Painter::Fill, 0, static_cast<std::uint32_t>(3 * (corners - 2)));
}

void PrimitiveVertices::append_stroke(const draw::Stroke& stroke) {
  assert(finite(stroke.from) && finite(stroke.to));
  const float dx = stroke.to.x - stroke.from.x, dy = stroke.to.y - stroke.from.y;
  const float length = std::sqrt(dx * dx + dy * dy);
  const bool round = stroke.cap == draw::Cap::Round;
  if (!(stroke.width > 0) || (length == 0 && !round)) return;
  const Point2 direction = length > 0 ? Point2{dx / length, dy / length} : Point2{1, 0};
  const float half = stroke.width / 2;
  const bool dashed = stroke.gap > 0 && stroke.dash >= 0;
  const Vertex flat{{},
                    {stroke.from.x, stroke.from.y, direction.x, direction.y},
                    {half, 0, dashed ? stroke.dash : 0, dashed ? stroke.gap : 0},
                    {length, stroke.phase, round ? 1.0f : 0.0f},
                    to_bytes(stroke.color)};
  const float cap = (round ? half : 0) + kFringe;
  append_quad(Painter::Shape, 0, flat,
              oriented_quad(stroke.from, direction, cap, length + cap, half + kFringe));
}

void PrimitiveVertices::append_disc(const draw::Disc& disc) {
  assert(finite(disc.center));
  if (!(disc.outer > 0) || !(disc.inner < disc.outer)) return;
  const bool ring = disc.inner > 0;
  const float middle = ring ? (disc.inner + disc.outer) / 2 : 0;
  const float half = ring ? (disc.outer - disc.inner) / 2 : disc.outer;
  const Vertex flat{{},
                    {disc.center.x, disc.center.y, 1, 0},
                    {half, middle, 0, 0},
                    {0, 0, 1},
                    to_bytes(disc.color)};
  const float reach = disc.outer + kFringe;
  append_quad(Painter::Shape, 0, flat, oriented_quad(disc.center, {1, 0}, reach, reach, reach));
}

void PrimitiveVertices::append_text(const draw::Text& text, GlyphAtlas& atlas) {
  assert(finite(text.at));
  if (!(text.size > 0)) return;
  const float width = text_width(text.text, text.size, text.weight);
  // The run is put on a quarter as a whole, so that a label that moves keeps its spacing.
  const float anchor = text.at.x - share_left_of_anchor(text.align) * width;
  const float start = std::floor(anchor * 4 + 0.5f) / 4;
  const int baseline = static_cast<int>(std::floor(text.at.y + 0.5f));
  const std::vector<char32_t> codes = code_points(text.text);
  const auto run = [&](float halo, const draw::Color& color) {
    float pen = start;
    for (const char32_t code : codes) {
      const int quarters = static_cast<int>(std::floor(pen * 4 + 0.5f));
      const int pixel = quarters >> 2;  // floor, also left of the frame
      append_glyph(atlas.find({code, text.size, text.weight, quarters & 3, halo}), pixel, baseline,
                   to_bytes(color));
      pen += advance(code, text.size, text.weight);
    }
  };
  if (text.halo > 0) run(text.halo, text.halo_color);
  run(0, text.color);
}

void PrimitiveVertices::append_glyph(const GlyphPlace& glyph, int pen_x, int baseline,
                                     const std::array<std::uint8_t, 4>& color) {
  if (glyph.width == 0) return;
  const float left = static_cast<float>(pen_x + glyph.left);
  const float top = static_cast<float>(baseline + glyph.top);
  const float right = left + static_cast<float>(glyph.width);
  const float bottom = top + static_cast<float>(glyph.height);
  Vertex flat{};
  flat.line[0] = static_cast<float>(glyph.x) - left;
  flat.line[1] = static_cast<float>(glyph.y) - top;
  flat.color = color;
  append_quad(Painter::Glyph, glyph.page, flat,
              {Point2{left, top}, {right, top}, {right, bottom}, {left, bottom}});
}

void PrimitiveVertices::append_quad(Painter painter, int page, const Vertex& flat,
                                    const std::array<Point2, 4>& corners) {
  const std::uint32_t first = static_cast<std::uint32_t>(vertices.size());
  Vertex vertex = flat;
  for (const Point2& corner : corners) {
    vertex.position[0] = corner.x;
    vertex.position[1] = corner.y;
    vertices.push_back(vertex);
  }
  indices.insert(indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  extend_batch(painter, page, 6);
}

void PrimitiveVertices::extend_batch(Painter painter, int page, std::uint32_t count) {
  if (batches.empty() || batches.back().painter != painter || batches.back().page != page) {
    batches.push_back({painter, page, static_cast<std::uint32_t>(indices.size()) - count, 0});
  }
  batches.back().count += count;
}

}  // namespace contactscope::gl

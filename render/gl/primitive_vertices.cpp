#include "gl/primitive_vertices.h"

namespace contactscope::gl {
namespace {

using draw::Point2;

// A pixel farther than half its diagonal from a shape has no coverage. The extra margin is for the
// driver's rounding of corners to 1/256 pixel.
constexpr float kFringe = 0.7072f + 1.0f / 64;

[[maybe_unused]] bool finite(const Point2& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// Corners of a rectangle: `back` behind `from`, `ahead` before it, and `side` to both sides of
/// `direction`.
std::array<Point2, 4> oriented_quad(const Point2& from, const Point2& direction, float back,
                                    float ahead, float side) {
  const auto corner = [&](float along, float across) {
    return from + along * direction + across * perpendicular(direction);
  };
  return {corner(-back, -side), corner(ahead, -side), corner(ahead, side), corner(-back, side)};
}

/// Rounds to 8 bits per channel, as the framebuffer does.
std::array<std::uint8_t, 4> to_bytes(const draw::Color& color) {
  const auto byte = [](float channel) {
    return static_cast<std::uint8_t>(std::clamp(channel, 0.0f, 1.0f) * 255 + 0.5f);
  };
  return {byte(color.r), byte(color.g), byte(color.b), byte(color.a)};
}

}  // namespace

void PrimitiveVertices::clear() {
  vertices.clear();
  indices.clear();
  batches.clear();
}

void PrimitiveVertices::append(const draw::Primitive& primitive) {
  std::visit([&](const auto& shape) { add(shape); }, primitive);
}

void PrimitiveVertices::add(const draw::Fill& fill) {
  assert(std::ranges::all_of(fill.polygon, finite));
  if (fill.polygon.size() < 3) return;
  add_polygon(Painter::Fill, 0, {{}, {}, {}, {}, to_bytes(fill.color)}, fill.polygon);
}

void PrimitiveVertices::add(const draw::Stroke& stroke) {
  assert(finite(stroke.from) && finite(stroke.to));
  const Point2 offset = stroke.to - stroke.from;
  const float run = std::sqrt(dot(offset, offset));
  const bool round = stroke.cap == draw::Cap::Round;
  if (!(stroke.width > 0) || (run == 0 && !round)) return;
  const Point2 direction = run > 0 ? offset / run : Point2{1, 0};
  const float half = stroke.width / 2;
  const bool dashed = stroke.gap > 0 && stroke.dash >= 0;
  const float cap = (round ? half : 0) + kFringe;
  add_polygon(Painter::Shape, 0,
              {{},
               {stroke.from.x, stroke.from.y, direction.x, direction.y},
               {half, 0, dashed ? stroke.dash : 0, dashed ? stroke.gap : 0},
               {run, stroke.phase, round ? 1.0f : 0.0f},
               to_bytes(stroke.color)},
              oriented_quad(stroke.from, direction, cap, run + cap, half + kFringe));
}

void PrimitiveVertices::add(const draw::Disc& disc) {
  assert(finite(disc.center));
  if (!(disc.outer > 0) || !(disc.inner < disc.outer)) return;
  const bool ring = disc.inner > 0;
  const float middle = ring ? (disc.inner + disc.outer) / 2 : 0;
  const float half = ring ? (disc.outer - disc.inner) / 2 : disc.outer;
  const float reach = disc.outer + kFringe;
  add_polygon(Painter::Shape, 0,
              {{},
               {disc.center.x, disc.center.y, 1, 0},
               {half, middle, 0, 0},
               {0, 0, 1},
               to_bytes(disc.color)},
              oriented_quad(disc.center, {1, 0}, reach, reach, reach));
}

void PrimitiveVertices::add(const draw::Text& text) {
  assert(finite(text.at));
  if (!(text.size > 0)) return;
  const float width = text_width(text.text, text.size, text.weight);
  // Left, middle and right are 0, 1 and 2 half widths from the left end.
  const float anchor = text.at.x - 0.5f * static_cast<float>(text.align) * width;
  // Snap the whole text to a quarter pixel, so that a moving label keeps its spacing.
  const float start = std::floor(anchor * 4 + 0.5f) / 4;
  const int baseline = static_cast<int>(std::floor(text.at.y + 0.5f));
  const std::vector<char32_t> codes = code_points(text.text);
  const auto run = [&](float halo, const draw::Color& color) {
    float pen = start;
    for (const char32_t code : codes) {
      const int quarters = static_cast<int>(std::floor(pen * 4 + 0.5f));
      const int pixel = quarters >> 2;  // floor, also for negative positions
      add_glyph(atlas.find({code, text.size, text.weight, quarters & 3, halo}), pixel, baseline,
                color);
      pen += advance(code, text.size, text.weight);
    }
  };
  if (text.halo > 0) run(text.halo, text.halo_color);
  run(0, text.color);
}

void PrimitiveVertices::add_glyph(const GlyphPlace& glyph, int pen_x, int baseline,
                                  const draw::Color& color) {
  if (glyph.width == 0) return;
  const float left = static_cast<float>(pen_x + glyph.left);
  const float top = static_cast<float>(baseline + glyph.top);
  const float right = left + static_cast<float>(glyph.width);
  const float bottom = top + static_cast<float>(glyph.height);
  const float in_page_x = static_cast<float>(glyph.x) - left;
  const float in_page_y = static_cast<float>(glyph.y) - top;
  add_polygon(Painter::Glyph, glyph.page, {{}, {in_page_x, in_page_y}, {}, {}, to_bytes(color)},
              std::array<Point2, 4>{{{left, top}, {right, top}, {right, bottom}, {left, bottom}}});
}

/// Adds a triangle fan; its corners share all attributes of `vertex` except the position.
void PrimitiveVertices::add_polygon(Painter painter, int page, Vertex vertex,
                                    std::span<const Point2> corners) {
  if (batches.empty() || batches.back().painter != painter || batches.back().page != page)
    batches.push_back({painter, page, static_cast<std::uint32_t>(indices.size()), 0});
  const std::uint32_t first = static_cast<std::uint32_t>(vertices.size());
  vertices.resize(first + corners.size(), vertex);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    vertices[first + i].position[0] = corners[i].x;
    vertices[first + i].position[1] = corners[i].y;
  }
  for (std::uint32_t i = 2; i < corners.size(); ++i)
    for (const std::uint32_t corner : {first, first + i - 1, first + i}) indices.push_back(corner);
  batches.back().count += static_cast<std::uint32_t>(3 * (corners.size() - 2));
}

const GlyphPlace& GlyphAtlas::find(const GlyphKey& key) {
  const auto found = places_.find(key);
  if (found != places_.end()) return found->second;
  const float subpixel = static_cast<float>(key.quarter) / 4;
  const GlyphBitmap bitmap =
      rasterize_glyph(key.code_point, key.size, key.weight, subpixel, key.halo);
  return places_.emplace(key, store(bitmap)).first->second;
}

/// Packs glyphs in rows as high as their highest glyph. A full row is followed by a new one below.
/// Labels have few sizes, so little space is wasted.
GlyphPlace GlyphAtlas::store(const GlyphBitmap& bitmap) {
  GlyphPlace place{
      .width = bitmap.width, .height = bitmap.height, .left = bitmap.left, .top = bitmap.top};
  if (bitmap.coverage.empty()) return place;
  if (bitmap.width > kSide || bitmap.height > kSide)
    throw std::length_error("a glyph is larger than a page of the atlas");
  if (!pages_.empty() && pages_.back().row_x + bitmap.width > kSide) {
    Page& full = pages_.back();
    full.row_top += full.row_height;
    full.row_height = full.row_x = 0;
  }
  if (pages_.empty() ||
      pages_.back().row_top + std::max(pages_.back().row_height, bitmap.height) > kSide)
    pages_.emplace_back();
  Page& page = pages_.back();
  place.page = static_cast<int>(pages_.size()) - 1;
  place.x = page.row_x;
  place.y = page.row_top;
  for (int row = 0; row < bitmap.height; ++row) {
    std::copy_n(
        bitmap.coverage.begin() + static_cast<std::ptrdiff_t>(row) * bitmap.width, bitmap.width,
        page.coverage.begin() + static_cast<std::ptrdiff_t>(place.y + row) * kSide + place.x);
  }
  page.row_x += bitmap.width;
  page.row_height = std::max(page.row_height, bitmap.height);
  const bool clean = page.changed_from == page.changed_to;
  page.changed_from = clean ? place.y : std::min(page.changed_from, place.y);
  page.changed_to = std::max(clean ? 0 : page.changed_to, place.y + bitmap.height);
  return place;
}

}  // namespace contactscope::gl

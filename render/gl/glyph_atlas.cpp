#include "gl/glyph_atlas.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace contactscope::gl {

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
  if (bitmap.width > kSide || bitmap.height > kSide) {
    throw std::length_error("a glyph is larger than a page of the atlas");
  }
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

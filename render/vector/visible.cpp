#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "image/font.h"
#include "vector/pieces.h"

namespace contactscope::vector {
namespace {

// Below half a step of eight bits, no pixel changes.
constexpr float kFaintest = 0.5f / 255;
// Soft borders extend this far beyond a shape, pixels.
constexpr float kSoftBorder = 1;

bool has_color(const draw::Color& color) { return color.a >= kFaintest; }

/// Bitmap of the pixels that later primitives cover opaquely.
class Covered {
 public:
  Covered(int width, int height)
      : width_(width),
        height_(height),
        words_((static_cast<std::size_t>(width) + 63) / 64),
        bits_(words_ * static_cast<std::size_t>(height)) {}

  /// Covers the pixels with centres inside a convex polygon.
  void cover(std::span<const Point2> polygon) {
    each_row(polygon, 0, [&](int row, float left, float right) {
      const int first = std::max(0, static_cast<int>(std::ceil(left - 0.5f)));
      const int last = std::min(width_ - 1, static_cast<int>(std::ceil(right - 0.5f)) - 1);
      if (first > last) return true;
      for_words(row, first, last, [](std::uint64_t& word, std::uint64_t mask) {
        word |= mask;
        return true;
      });
      return true;
    });
  }

  /// True if all pixels that a convex polygon touches and their neighbours are covered.
  bool hides(std::span<const Point2> polygon) {
    return each_row(polygon, kSoftBorder, [&](int row, float left, float right) {
      const int first = std::max(0, static_cast<int>(std::floor(left - kSoftBorder)));
      const int last = std::min(width_ - 1, static_cast<int>(std::floor(right + kSoftBorder)));
      if (first > last) return true;
      return for_words(row, first, last, [](const std::uint64_t& word, std::uint64_t mask) {
        return (word & mask) == mask;
      });
    });
  }

  bool meets(std::span<const Point2> polygon) const {
    float left = 1e30f, right = -1e30f, top = 1e30f, bottom = -1e30f;
    for (const Point2& p : polygon) {
      left = std::min(left, p.x);
      right = std::max(right, p.x);
      top = std::min(top, p.y);
      bottom = std::max(bottom, p.y);
    }
    return right > -kSoftBorder && bottom > -kSoftBorder &&
           left < static_cast<float>(width_) + kSoftBorder &&
           top < static_cast<float>(height_) + kSoftBorder;
  }

 private:
  /// Calls `use` with the polygon's extent in each row: on the row's centre line if `border` is 0,
  /// else over the row and `border` pixels above and below. Stops if `use` returns false.
  template <class Use>
  bool each_row(std::span<const Point2> polygon, float border, const Use& use) const {
    float top = std::numeric_limits<float>::max(), bottom = -top;
    for (const Point2& p : polygon) {
      top = std::min(top, p.y);
      bottom = std::max(bottom, p.y);
    }
    const int first = std::max(0, static_cast<int>(std::floor(top - border)));
    const int last = std::min(height_ - 1, static_cast<int>(std::floor(bottom + border)));
    for (int row = first; row <= last; ++row) {
      const float middle = static_cast<float>(row) + 0.5f;
      const float low = border > 0 ? middle - 0.5f - border : middle;
      const float high = border > 0 ? middle + 0.5f + border : middle;
      float left = std::numeric_limits<float>::max(), right = -left;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if (a.y > b.y) std::swap(a, b);
        if (b.y < low || a.y > high) continue;
        const float rise = b.y - a.y;
        const auto x_at = [&](float y) { return a.x + (b.x - a.x) * (y - a.y) / rise; };
        const float x0 = a.y < low && rise > 0 ? x_at(low) : a.x;
        const float x1 = b.y > high && rise > 0 ? x_at(high) : b.x;
        left = std::min({left, x0, x1});
        right = std::max({right, x0, x1});
      }
      if (left <= right && !use(row, left, right)) return false;
    }
    return true;
  }

  template <class Use> bool for_words(int row, int first, int last, const Use& use) {
    std::uint64_t* words = bits_.data() + static_cast<std::size_t>(row) * words_;
    for (int word = first / 64; word <= last / 64; ++word) {
      std::uint64_t mask = ~std::uint64_t{0};
      if (word == first / 64) mask &= ~std::uint64_t{0} << (first % 64);
      if (word == last / 64) mask &= ~std::uint64_t{0} >> (63 - last % 64);
      if (!use(words[word], mask)) return false;
    }
    return true;
  }

  int width_, height_;
  std::size_t words_;  // per row
  std::vector<std::uint64_t> bits_;
};

std::vector<Point2> box(float left, float top, float right, float bottom) {
  return {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
}

/// Convex polygon around all pixels of a primitive; empty if it paints nothing.
std::vector<Point2> around(const draw::Fill& fill) {
  if (fill.polygon.size() < 3 || !has_color(fill.color)) return {};
  return fill.polygon;
}
std::vector<Point2> around(const draw::Stroke& stroke) {
  const Point2 offset = stroke.to - stroke.from;
  const float run = length(offset);
  const bool round = stroke.cap == draw::Cap::Round;
  if (!(stroke.width > 0) || (run == 0 && !round) || !has_color(stroke.color)) return {};
  const float half = 0.5f * stroke.width;
  const Point2 along = run > 0 ? offset / run : Point2{1, 0};
  const Point2 aside = half * perpendicular(along), ahead = (round ? half : 0) * along;
  return {stroke.from - ahead - aside, stroke.to + ahead - aside, stroke.to + ahead + aside,
          stroke.from - ahead + aside};
}
std::vector<Point2> around(const draw::Disc& disc) {
  if (!(disc.outer > 0) || !(disc.inner < disc.outer) || !has_color(disc.color)) return {};
  return box(disc.center.x - disc.outer, disc.center.y - disc.outer, disc.center.x + disc.outer,
             disc.center.y + disc.outer);
}
std::vector<Point2> around(const draw::Text& text) {
  const bool halo = text.halo > 0 && has_color(text.halo_color);
  if (!(text.size > 0) || text.text.empty() || (!has_color(text.color) && !halo)) return {};
  const float width = text_width(text.text, text.size, text.weight);
  const float left = text.at.x - 0.5f * static_cast<float>(text.align) * width;
  // Letters such as "j" extend a little to the left of the pen.
  const float border = 0.2f * text.size + std::max(0.0f, text.halo);
  return box(left - border, text.at.y - ascent(text.size, text.weight) - border,
             left + width + border, text.at.y + descent(text.size, text.weight) + border);
}

}  // namespace

std::vector<bool> visible(const draw::Drawing& drawing) {
  std::vector<bool> seen(drawing.primitives.size());
  Covered covered(drawing.width, drawing.height);
  for (std::size_t i = drawing.primitives.size(); i-- > 0;) {
    const draw::Primitive& primitive = drawing.primitives[i];
    const std::vector<Point2> polygon =
        std::visit([](const auto& shape) { return around(shape); }, primitive);
    if (polygon.empty() || !covered.meets(polygon) || covered.hides(polygon)) continue;
    seen[i] = true;
    const auto* fill = std::get_if<draw::Fill>(&primitive);
    if (fill != nullptr && fill->color.a >= 1) covered.cover(polygon);
  }
  return seen;
}

}  // namespace contactscope::vector

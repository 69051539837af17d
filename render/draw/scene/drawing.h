#pragma once

#include "core/standard.h"
#include "image/font.h"

namespace contactscope {
class Words;
}

/// A picture as shapes in pixels, in painting order. Perspective, depth order and hidden lines are
/// already resolved, so that pixels and vector files come from one list.
namespace contactscope::draw {

/// Straight (not premultiplied) sRGB colour, 0 to 1.
struct Color {
  float r = 0, g = 0, b = 0, a = 1;
  friend bool operator==(const Color&, const Color&) = default;
};

/// Pixels from the top left corner of the canvas, y down; pixel centres at half-integers. Also used
/// for the offset between two points.
struct Point2 {
  float x = 0, y = 0;

  friend bool operator==(const Point2&, const Point2&) = default;
  friend Point2 operator+(const Point2& a, const Point2& b) { return {a.x + b.x, a.y + b.y}; }
  friend Point2 operator-(const Point2& a, const Point2& b) { return {a.x - b.x, a.y - b.y}; }
  friend Point2 operator*(float s, const Point2& p) { return {s * p.x, s * p.y}; }
  friend Point2 operator/(const Point2& p, float s) { return {p.x / s, p.y / s}; }
  friend float dot(const Point2& a, const Point2& b) { return a.x * b.x + a.y * b.y; }
  friend float cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }
  friend float length(const Point2& p) { return std::hypot(p.x, p.y); }
  friend float distance(const Point2& a, const Point2& b) { return length(b - a); }
  /// `p` turned by 90 degrees, clockwise on the screen.
  friend Point2 perpendicular(const Point2& p) { return {-p.y, p.x}; }
};

/// Converts from double.
inline Point2 pixel(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }

struct Segment2 {
  Point2 from, to;

  /// The point of the segment that is nearest to `p`.
  Point2 nearest(const Point2& p) const {
    const Point2 offset = to - from;
    const float squared = dot(offset, offset);
    if (!(squared > 0)) return from;
    return from + std::clamp(dot(p - from, offset) / squared, 0.0f, 1.0f) * offset;
  }
};

/// Rectangle on the canvas, pixels.
struct Rect {
  double x = 0, y = 0, width = 0, height = 0;

  bool operator==(const Rect&) const = default;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
  bool contains(const Point2& p) const {
    return p.x >= x && p.x <= right() && p.y >= y && p.y <= bottom();
  }
  bool encloses(const Rect& other) const {
    return other.x >= x && other.y >= y && other.right() <= right() && other.bottom() <= bottom();
  }
  bool overlaps(const Rect& other) const {
    return x < other.right() && other.x < right() && y < other.bottom() && other.y < bottom();
  }
  /// One of equal cells, row by row, with gaps between them.
  Rect cell(std::size_t i, std::size_t columns, std::size_t rows, double across,
            double down) const {
    const auto column = static_cast<double>(i % columns), row = static_cast<double>(i / columns);
    const auto wide = static_cast<double>(columns), high = static_cast<double>(rows);
    const double w = (width - across * (wide - 1)) / wide, h = (height - down * (high - 1)) / high;
    return {x + column * (w + across), y + row * (h + down), w, h};
  }
  /// The rectangle with `by` pixels added on each side.
  Rect grown(double by) const { return {x - by, y - by, width + 2 * by, height + 2 * by}; }
  /// The point of the rectangle that is nearest to `p`.
  Point2 nearest(const Point2& p) const {
    return pixel(std::clamp<double>(p.x, x, right()), std::clamp<double>(p.y, y, bottom()));
  }
};

/// Filled convex polygon, either winding, without anti-aliased border (neighbours share edges).
struct Fill {
  std::vector<Point2> polygon;
  Color color{};
};

enum class Cap { Butt, Round };

/// Straight line with analytic anti-aliasing. `dash` and `gap` in pixels, no dashes when gap is 0;
/// `phase` is the distance already run along the dash pattern at `from`.
struct Stroke {
  Point2 from, to;
  float width = 1;  // pixels
  Color color{};
  Cap cap = Cap::Butt;
  float dash = 0, gap = 0, phase = 0;
};

/// Disc or ring with analytic anti-aliasing: painted where inner <= distance from centre <= outer.
struct Disc {
  Point2 center;
  float inner = 0, outer = 1;  // pixels
  Color color{};
};

using Weight = FontWeight;
enum class Align { Left, Center, Right };

/// One line of UTF-8 text. `at` is on the baseline, at its left end, middle or right end.
struct Text {
  std::string text;
  Point2 at;
  float size = 14;  // pixels from ascender to descender
  Weight weight = Weight::Regular;
  Align align = Align::Left;
  Color color{};
  float halo = 0;  // width in pixels of a soft border around the letters
  Color halo_color{1, 1, 1, 1};
};

using Primitive = std::variant<Fill, Stroke, Disc, Text>;

/// Describes consecutive primitives of a drawing, from primitive `first` to the start of the next
/// part.
struct Part {
  std::size_t first = 0;
  std::string layer;   // a layer as scenarios spell it, or one of the names below
  std::string pair{};  // "table crate", A and B as in the trace; empty if it shows no pair
  std::string
      role{};  // "surface", "line", "arrow", "mark" or "label"; for a panel or inset its name
};

// Names of parts other than the view's layers.
inline constexpr std::string_view kTitlePart = "title", kSourcePart = "source",
                                  kMomentPart = "moment", kLegendPart = "legend",
                                  kPanelPart = "panel", kInsetPart = "inset",
                                  kPairLabelPart = "pair_label", kShapeNamesPart = "shape_names",
                                  kPlanePart = "contact_plane", kBreakPart = "break";

/// Text that names something, and the place of that thing.
struct Callout {
  std::size_t text = 0;  // the primitive, a Text
  Point2 at;             // the named place, pixels
  std::string layer{}, pair{};
};

struct Drawing {
  int width = 0, height = 0;            // pixels
  Color background{1, 1, 1, 1};         // alpha 0: transparent
  std::vector<Primitive> primitives{};  // painted in this order
  std::vector<Part> parts{};            // in order of `first`
  std::vector<Callout> callouts{};      // in order of `text`
  /// Size of a pixel on paper; CSS has 96 pixels an inch.
  double points_per_pixel = 0.75;
  /// Translations of the texts that a Pen writes; null: none. Outlives the drawing.
  const Words* words = nullptr;

  /// Starts a new part: primitives added from here on belong to it.
  void begin(std::string_view layer, std::string_view pair = {}, std::string_view role = {});
  /// The same without the parts for which `wanted` is false. Primitives before the first part belong
  /// to a part without names.
  Drawing taken(const std::function<bool(const Part&)>& wanted) const;
  /// Adds the contents of another drawing, moved by `offset` pixels. The canvas size stays.
  void append(const Drawing& other, const Point2& offset = {});
};

}  // namespace contactscope::draw

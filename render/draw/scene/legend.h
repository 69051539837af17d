#pragma once

#include <string>
#include <vector>

#include "draw/scene/drawing.h"
#include "draw/scene/layout.h"
#include "draw/scene/pen.h"

/// The legend of a picture: what each sign in it means.
namespace contactscope::draw {

class SwatchPen;

/// What a legend explains, in its order.
enum class LegendGroup {
  Shapes,
  Cores,
  Faces,
  Points,
  Forces,
  Motion,
  Masses,
  Axes,
  Trees,
  Differences,
  Directions,
};

/// How a sign looks in the legend, and where it stands there. Each is a constant beside the code that
/// draws the sign, and is known by its address.
struct Swatch {
  LegendGroup group;
  int place;  // within the group
  void (*draw)(const SwatchPen&);
};

struct LegendEntry {
  const Swatch* swatch = nullptr;
  std::string text;

  bool operator==(const LegendEntry&) const = default;
};

class Legend {
 public:
  /// Adds an entry unless it stands there already.
  void explain(const Swatch& swatch, const std::string& text);
  /// Adds those of another that are new.
  void explain(const Legend& other);
  /// In the order in which a picture lists them.
  std::vector<LegendEntry> sorted() const;

 private:
  std::vector<LegendEntry> entries_;
};

/// Draws a swatch. Its own lengths and places are in pixels at 720 lines, places from the left end of
/// the swatch, halfway up.
class SwatchPen : public Pen {
 public:
  SwatchPen(const Layout& layout, const Point2& left, Drawing& drawing)
      : Pen(drawing, layout.scale, kLegendSize), left_(left) {}

  static constexpr double kLegendSize = 15;  // of the text

  Point2 at(double right, double down = 0) const {
    return {left_.x + px(right), left_.y + px(down)};
  }
  Point2 middle() const { return at(11); }

  void level_line(double from, double to, double width, const Color& color) const {
    line(at(from), at(to), width, color);
  }
  void dashes(double width, const Color& color) const { line(left_, at(23), width, color, 6, 2.5); }
  /// A ring, or a disc where `inner` is 0.
  void dot(double inner, double outer, const Color& color) const {
    ring(middle(), inner, outer, color);
  }
  void box(const Color& fill_color, const Color& border, double width, bool dashed = false) const;
  void hatched(const Color& color) const;
  void crossed(const Color& color) const { cross(middle(), 4.5, 2, color, Cap::Round); }
  /// Head of an arrow whose tip is there; `size` < 0: to the left.
  void head(double tip, double size, const Color& color) const;
  void arrow(double width, double size, const Color& color) const {
    level_line(0, 14, width, color);
    head(22, size, color);
  }
  /// Its head is two strokes.
  void open_arrow(double width, const Color& color) const {
    level_line(0, 21, width, color);
    for (const double side : {-4.5, 4.5}) path({at(21), at(12, side)}, width, color);
  }
  /// Down from the middle.
  void whisker(double width, const Color& color) const {
    line(middle(), {middle().x, at(0, 9).y}, width, color);
  }

 private:
  Point2 left_;
};

/// Width of an entry's swatch and text in pixels, and the gap to the next.
float legend_entry_width(const LegendEntry& entry, float scale);

/// Paints the legend into its rectangle.
void draw_legend(const std::vector<LegendEntry>& entries, const Layout& layout, Drawing& drawing);

}  // namespace contactscope::draw

#pragma once

#include "core/convex_polygon.h"
#include "draw/scene/drawing.h"

namespace contactscope::draw {

/// Text that is already translated for the reader.
struct Said {
  std::string text;
};

/// Adds 2D elements to a drawing: charts, maps and rows of text. Places are canvas pixels; widths
/// of lines, dashes and text sizes are pixels at 720 lines.
class Pen {
 public:
  Pen(Drawing& drawing, float scale, double text_size)
      : out_(drawing), scale_(scale), text_size_(text_size) {}

  float px(double at_720) const { return scale_ * static_cast<float>(at_720); }
  float scale() const { return scale_; }
  /// Sets the default text size, pixels at 720 lines.
  void write_in(double text_size) { text_size_ = text_size; }
  Drawing& drawing() const { return out_; }

  /// Translates a text of the program for the reader; unchanged without a translation.
  Said said(const std::string& what) const;
  /// The same, shortened with an ellipsis to `available` pixels. A `size` of 0 is the pen's own.
  Said fitted(const std::string& what, Weight weight, float available, double size = 0) const;
  /// `at` on the baseline. A `size` of 0 is the pen's own.
  void text(const std::string& what, const Point2& at, Align align, const Color& color,
            Weight weight = Weight::Regular, double size = 0, double halo = 0) const {
    text(said(what), at, align, color, weight, size, halo);
  }
  void text(const Said& what, const Point2& at, Align align, const Color& color,
            Weight weight = Weight::Regular, double size = 0, double halo = 0) const;
  /// Width in canvas pixels at the pen's own size.
  float width_of(const std::string& what, Weight weight = Weight::Regular) const {
    return width_of(said(what), weight);
  }
  float width_of(const Said& what, Weight weight = Weight::Regular) const;

  /// A line with butt caps. If `gap` is 0, it is 0.7 times the dash.
  void line(const Point2& from, const Point2& to, double width, const Color& color, double dash = 0,
            double gap = 0) const;
  /// A line along all points. Dashes continue across corners. Segments that are straight to a tenth
  /// of a pixel are merged into one stroke, because their round ends would look like beads.
  void path(const std::vector<Point2>& points, double width, const Color& color, double dash = 0,
            double gap = 0) const;
  /// Around a polygon; dashes restart at each corner.
  void outline(const std::vector<Point2>& polygon, double width, const Color& color,
               double dash = 0) const;
  void frame(const Rect& rect, double width, const Color& color) const;
  void fill(std::vector<Point2> polygon, const Color& color) const;
  void fill(const Rect& rect, const Color& color) const;
  void disc(const Point2& center, double radius, const Color& color) const;
  void ring(const Point2& center, double inner, double outer, const Color& color) const;
  /// Two diagonal strokes that extend `radius` from the middle along each axis.
  void cross(const Point2& at, double radius, double width, const Color& color,
             Cap cap = Cap::Butt) const;
  /// Rising lines over the part of the convex polygon `whole` outside the convex polygon `hole`,
  /// both with the winding of convex_polygon. A hole with fewer than three corners is ignored.
  void hatch(const std::vector<Vec2d>& whole, const std::vector<Vec2d>& hole, double spacing,
             double width, const Color& color) const;

 private:
  Stroke stroke(const Point2& from, const Point2& to, double width, const Color& color, double dash,
                double gap) const;

  Drawing& out_;
  float scale_;
  double text_size_;
};

/// Corners of a rectangle, from the top left one.
std::vector<Point2> corners_of(const Rect& rect);

}  // namespace contactscope::draw

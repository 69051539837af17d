#pragma once

#include <string>
#include <vector>

#include "core/convex_polygon.h"
#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
#include "image/font.h"

namespace contactscope::draw {

/// Text in the words of the drawing's reader, which is not to be put into them again.
struct Said {
  std::string text;
};

/// Adds flat things to a drawing: charts, maps and rows of text. Places are pixels of the canvas;
/// widths of lines, dashes and sizes of text are pixels at 720 lines.
class Pen {
 public:
  Pen(Drawing& drawing, float scale, double text_size)
      : out_(drawing), scale_(scale), text_size_(text_size) {}

  float px(double at_720) const { return scale_ * static_cast<float>(at_720); }
  float scale() const { return scale_; }
  /// Of text that says no size of its own, pixels at 720 lines.
  void write_in(double text_size) { text_size_ = text_size; }
  Drawing& drawing() const { return out_; }

  /// The program's own words as the drawing's reader says them: as they are, where it has no others.
  Said said(const std::string& what) const;
  /// The same, shortened with an ellipsis where it does not fit into `available` pixels. A `size` of 0
  /// is the pen's own.
  Said fitted(const std::string& what, Weight weight, float available, double size = 0) const;
  /// `at` on the baseline. A `size` of 0 is the pen's own.
  void text(const std::string& what, const Point2& at, Align align, const Color& color,
            Weight weight = Weight::Regular, double size = 0, double halo = 0) const {
    text(said(what), at, align, color, weight, size, halo);
  }
  void text(const Said& what, const Point2& at, Align align, const Color& color,
            Weight weight = Weight::Regular, double size = 0, double halo = 0) const;
  /// Pixels of the canvas, at the pen's own size.
  float width_of(const std::string& what, Weight weight = Weight::Regular) const {
    return width_of(said(what), weight);
  }
  float width_of(const Said& what, Weight weight = Weight::Regular) const;

  /// With butt caps. A `gap` of 0 after a dash is seven tenths of it.
  void line(const Point2& from, const Point2& to, double width, const Color& color, double dash = 0,
            double gap = 0) const;
  /// Along all points; dashes run on from one to the next, and neighbours that lie on a line to a
  /// tenth of a pixel share one stroke: their round ends would bead it.
  void path(const std::vector<Point2>& points, double width, const Color& color, double dash = 0,
            double gap = 0) const;
  /// Around a polygon; dashes begin anew at each corner.
  void outline(const std::vector<Point2>& polygon, double width, const Color& color,
               double dash = 0) const;
  void frame(const Rect& rect, double width, const Color& color) const;
  void fill(std::vector<Point2> polygon, const Color& color) const;
  void fill(const Rect& rect, const Color& color) const;
  void disc(const Point2& center, double radius, const Color& color) const;
  void ring(const Point2& center, double inner, double outer, const Color& color) const;
  /// Two strokes, `radius` to each side of the middle along each axis.
  void cross(const Point2& at, double radius, double width, const Color& color,
             Cap cap = Cap::Butt) const;
  /// Rising lines over what of convex polygon `whole` lies outside convex polygon `hole`, both in the
  /// winding of convex_polygon. A hole of fewer than three corners is none.
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

#pragma once

#include <string>
#include <vector>

#include "draw/charts/log_axis.h"
#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
#include "draw/scene/layout.h"
#include "trace/study.h"

namespace contactscope::draw {

inline constexpr Color kPlotGrid{0.835f, 0.855f, 0.875f, 1};
inline constexpr Color kPlotBorder{0.541f, 0.565f, 0.600f, 1};

/// Pen for the small multiples of a study. Sizes are pixels at 720 lines.
class PlotCanvas {
 public:
  PlotCanvas(Drawing& drawing, float scale) : out_(drawing), scale_(scale) {}

  float px(double at_720) const { return scale_ * static_cast<float>(at_720); }
  Drawing& drawing() { return out_; }

  void text(const std::string& what, const Point2& at, Align align, const Color& color,
            Weight weight = Weight::Regular);
  float width_of(const std::string& what, Weight weight = Weight::Regular) const;
  void line(const Point2& from, const Point2& to, double width, const Color& color,
            double dash = 0);
  void fill(const Rect& rect, const Color& color);
  void cross(const Point2& at, double radius, const Color& color);
  void frame(const Rect& area);

  /// Labels as many decades as fit under the lower edge of the area, and draws their grid lines if
  /// asked to.
  void ticks_along(const LogAxis& axis, const Rect& area, bool grid);
  /// The same along its left edge; without labels the grid alone.
  void ticks_up(const LogAxis& axis, const Rect& area, bool grid, bool labels);

 private:
  Drawing& out_;
  float scale_;
};

/// The panels of a study, in the order of the series, which stay together.
struct PlotPanel {
  std::string name;
  std::string parameter;
  std::vector<const trace::StudySeries*> series;
};
std::vector<PlotPanel> panels_of(const trace::Study& study);

/// Places for so many panels in two rows, with room for labels to the left of each row and under
/// each panel, and for a heading over it; `left` in pixels at 720 lines.
std::vector<Rect> panel_areas(const Rect& space, std::size_t count, double left, float scale);

/// "CPU · compiler · build · date".
std::string spell_context(const trace::StudyContext& context);

/// A picture of small multiples: its frame is drawn, and says where the rest belongs.
struct PlotPage {
  Drawing drawing;
  float scale;
  Point2 legend;  // its left end, half-way up
  Rect panels;
};
/// With the captions of a study, and under its title a line that says what is shown.
PlotPage plot_page(const trace::Study& study, const std::string& shown, int width, int height);

}  // namespace contactscope::draw

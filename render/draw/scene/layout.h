#pragma once

#include <string>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
#include "draw/scene/figure_style.h"
#include "image/font.h"

namespace contactscope::draw {

inline constexpr double kLegendRow = 24;  // height, pixels at 720 lines
inline constexpr double kEntryGap = 22;   // between texts that stand side by side

/// Where things go on a canvas. Sizes are given for 1280 x 720 and grow or shrink with it, but text
/// stays legible on small pictures.
struct Layout {
  int width = 0, height = 0;
  float scale = 1;             // pixels for one pixel at 720 lines
  Rect view{};                 // the 3D view
  Rect panels{};               // right column; empty width when the view names no panels
  Rect legend{};               // rows of the legend, under the view
  std::vector<Rect> insets{};  // beside the view and together as large, one above the other
  Rect page{};                 // all of it but the margins
  double title_size = 28;      // pixels at 720 lines
  int title_lines = 1;         // 0: it has no title
  bool footer = true;
  bool framed = false;           // a frame is drawn around the view
  bool ground = true;            // panels have a ground of their own
  const Words* words = nullptr;  // of the drawings

  float px(double at_720) const { return scale * static_cast<float>(at_720); }
  /// Of the source and the moment, a margin above the lower border; their letters reach below it.
  double footer_baseline() const;
};

/// `legend_widths`: for each picture of the sequence the widths of its legend's entries, so that
/// the view is as large in every frame. A title that is empty takes no room. The style outlives the layout.
Layout make_layout(int width, int height, bool has_panels,
                   const std::vector<std::vector<float>>& legend_widths, int insets = 0,
                   const FigureStyle& style = {}, const std::optional<std::string>& title = {});

/// Text that must fit into `available` pixels: shortened with an ellipsis where it does not.
std::string fitted(const std::string& text, float size, FontWeight weight, float available);

/// Scale of text and lines on a canvas; 1 at 720 lines, or what a style asks for.
float interface_scale(int width, int height, const FigureStyle& style = {});

/// Pixels that type of the style is high, from ascender to descender, where its letters' em is so
/// many: the size of a font in print.
double type_of_em(double em_pixels);

/// A title in as many lines as it takes.
struct FittedTitle {
  std::vector<std::string> lines;  // one or two
  double size = 0;                 // of its letters, pixels at 720 lines
};

/// Smaller where it is wider than `room` pixels, in two lines where that would be too small, and
/// cut with an ellipsis where even these are too narrow.
FittedTitle fit_title(const std::string& title, float room, float scale);

/// Title top left, source bottom left, frame and time bottom right.
void draw_captions(const std::string& title, const std::string& source, const std::string& moment,
                   const Layout& layout, Drawing& drawing);

}  // namespace contactscope::draw

#pragma once

#include <string>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
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

  float px(double at_720) const { return scale * static_cast<float>(at_720); }
};

/// `legend_widths`: for each picture of the sequence the widths of its legend's entries, so that
/// the view is as large in every frame.
Layout make_layout(int width, int height, bool has_panels,
                   const std::vector<std::vector<float>>& legend_widths, int insets = 0);

/// Text that must fit into `available` pixels: shortened with an ellipsis where it does not.
std::string fitted(const std::string& text, float size, FontWeight weight, float available);

/// Scale of text and lines on a canvas; 1 at 720 lines.
float interface_scale(int width, int height);

/// Title top left, source bottom left, frame and time bottom right.
void draw_captions(const std::string& title, const std::string& source, const std::string& moment,
                   const Layout& layout, Drawing& drawing);

}  // namespace contactscope::draw

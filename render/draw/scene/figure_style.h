#pragma once

#include <memory>
#include <optional>

#include "draw/scene/theme.h"
#include "view/words.h"

namespace contactscope::draw {

/// The author's settings of a picture. The defaults change nothing.
struct FigureStyle {
  /// Text size in legends and panels, pixels from ascender to descender; 0: follows the canvas.
  double type = 0;
  double scale = 1;       // factor of all sizes: type, lines, signs
  double line_width = 1;  // factor of the widths of lines
  /// Pixels at 720 lines, on all sides. A figure may need none: its page has margins.
  std::optional<double> margin{};
  bool title = true, legend = true, footer = true;
  Theme theme = Theme::Light;
  std::optional<Color> background{};  // alpha 0: transparent; default: the theme's ground
  double points_per_pixel = 0.75;
  /// If the canvas is too narrow for panels and insets next to the view, they are placed below it.
  /// Their total height in pixels; 0: a share of the canvas.
  double height_below = 0;
  std::shared_ptr<const Words> words{};  // null: no translation

  /// Whether sizes and places follow the author's settings instead of the canvas size.
  bool follows() const { return type > 0 || scale != 1 || margin; }
};

/// Applies line widths, colours and the size of a pixel to a complete drawing, panels included.
void finish(const FigureStyle& style, Drawing& drawing);

}  // namespace contactscope::draw

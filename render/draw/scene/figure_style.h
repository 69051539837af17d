#pragma once

#include <memory>
#include <optional>

#include "core/words.h"
#include "draw/scene/theme.h"

namespace contactscope::draw {

/// What an author sets of a picture, whatever it shows. As it stands it changes nothing.
struct FigureStyle {
  /// Pixels from ascender to descender of the text in legends and panels; 0: as the canvas is large.
  double type = 0;
  double scale = 1;       // factor of all sizes: type, lines, signs
  double line_width = 1;  // factor of the widths of lines
  /// Pixels at 720 lines, around everything; a figure has the white of its page around it.
  std::optional<double> margin{};
  bool title = true, legend = true, footer = true;
  Theme theme = Theme::Light;
  std::optional<Color> background{};  // alpha 0: none; default: the theme's ground
  double points_per_pixel = 0.75;
  /// Of an upright page: where the canvas is too narrow for panels and insets beside the view, they
  /// stand below, so many pixels high together; 0: a share of the canvas.
  double height_below = 0;
  std::shared_ptr<const Words> words{};  // null: the program's own

  /// Whether sizes follow what the author asks for, and places follow them.
  bool follows() const { return type > 0 || scale != 1 || margin; }
};

/// What is left to do with a drawing that is complete, panels included: the widths of lines, the
/// colours, the size of a pixel.
void finish(const FigureStyle& style, Drawing& drawing);

}  // namespace contactscope::draw

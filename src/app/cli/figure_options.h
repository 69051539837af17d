#pragma once

#include <iosfwd>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "draw/scene/drawing.h"
#include "draw/scene/figure_style.h"

/// Options of figures for talks and papers, shared by all verbs that draw.
namespace contactscope::app {

/// A length as text: "84mm", "8pt", "992px".
struct FigureLength {
  double value = 0;  // points of 1/72 inch, or pixels
  bool in_pixels = false;

  double pixels(double dpi) const { return in_pixels ? value : value * dpi / 72; }
};

/// The options, as read.
struct FigureOptions {
  std::string words;               // a file
  std::vector<std::string> fonts;  // regular, and optionally bold
  double dpi = 300;                // pixels per inch for physical sizes
  double scale = 1, line_width = 1;
  bool bare = false, no_title = false, no_legend = false, no_footer = false;

  std::optional<FigureLength> width{}, height{}, font_size{};
  draw::Theme theme = draw::Theme::Light;
  std::optional<draw::Color> background{};

  draw::FigureStyle style{};  // of all these, without `words`, which also depend on the scenario
};

/// Checks options that depend on each other, sets `style` and opens the fonts. Throws UsageError, FontError.
void finish_figure(FigureOptions& figure, bool has_size);

/// Characters without a glyph in any font, over all drawings of a run.
class MissingGlyphs {
 public:
  void look(const draw::Drawing& drawing);
  /// Prints the characters and a remedy once; nothing if none is missing.
  void report(std::ostream& out) const;

 private:
  std::set<char32_t> missing_;
};

}  // namespace contactscope::app

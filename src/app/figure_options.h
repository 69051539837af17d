#pragma once

#include <iosfwd>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "draw/scene/drawing.h"
#include "draw/scene/figure_style.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Options of figures for talks and papers, shared by all verbs that draw.
namespace contactscope::app {

/// A length as text: "84mm", "8pt", "992px".
struct FigureLength {
  double value = 0;  // points of 1/72 inch, or pixels
  bool in_pixels = false;

  double pixels(double dpi) const { return in_pixels ? value : value * dpi / 72; }
};

/// The options as text, and their values.
struct FigureOptions {
  std::string width_text, height_text, font_size_text, background_text, theme_text;
  std::string words;               // a file
  std::vector<std::string> fonts;  // regular, and optionally bold
  double dpi = 300;                // pixels per inch for physical sizes
  double scale = 1, line_width = 1;
  bool bare = false, no_title = false, no_legend = false, no_footer = false;

  std::optional<FigureLength> width{}, height{}, font_size{};
  draw::FigureStyle style{};  // without `words`, which also depend on the scenario
};

/// Options of all figures, in the format of Verb::arguments.
inline constexpr const char* kFigureArguments =
    "--width --height --font-size --dpi --scale --line-width --bare --no-title --no-legend "
    "--no-footer --background --theme --words --font";

/// Adds the option of this name with its help; null if it is not one of a figure.
CLI::Option* add_figure_option(CLI::App& verb, const std::string& name, FigureOptions& to);

/// Parses the texts and opens the fonts. Throws UsageError, FontError.
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

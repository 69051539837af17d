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

/// What authors of talks and papers set of their figures, the same for every verb that draws.
namespace contactscope::app {

/// A length as an author writes it: "84mm", "8pt", "992px".
struct FigureLength {
  double value = 0;  // points of 1/72 inch, or pixels
  bool in_pixels = false;

  double pixels(double dpi) const { return in_pixels ? value : value * dpi / 72; }
};

/// The options as they were written, and what they say.
struct FigureOptions {
  std::string width_text, height_text, font_size_text, background_text, theme_text;
  std::string words;               // file, or the name of one that is installed
  std::vector<std::string> fonts;  // regular, and bold where there is one
  double dpi = 300;                // pixels an inch of what has a size on paper
  double scale = 1, line_width = 1;
  bool bare = false, no_title = false, no_legend = false, no_footer = false;

  std::optional<FigureLength> width{}, height{}, font_size{};
  draw::FigureStyle style{};  // without words, which a scenario has a part in
};

/// The options of all figures, as a verb lists its arguments.
inline constexpr const char* kFigureArguments =
    "--width --height --font-size --dpi --scale --line-width --bare --no-title --no-legend "
    "--no-footer --background --theme --words --font";

/// Adds the option of that name, with its help; null where it is none of a figure.
CLI::Option* add_figure_option(CLI::App& verb, const std::string& name, FigureOptions& to);

/// Reads what was written, and opens the fonts. Throws UsageError, FontError.
void finish_figure(FigureOptions& figure, bool has_size);

/// Characters that no font has, over all drawings of a run.
class MissingGlyphs {
 public:
  void look(const draw::Drawing& drawing);
  /// Names the characters and the remedy, once; nothing where none is missing.
  void tell(std::ostream& out) const;

 private:
  std::set<char32_t> missing_;
};

}  // namespace contactscope::app

#include <CLI/CLI.hpp>

#include "app/figure_options.h"

/// In its own file because only the program depends on CLI11, not the library.
namespace contactscope::app {

CLI::Option* add_figure_option(CLI::App& verb, const std::string& name, FigureOptions& to) {
  const auto value = [&](auto& target, const char* help) {
    return verb.add_option(name, target, help);
  };
  const auto factor = [&](double& target, const char* help) {
    return verb.add_option(name, target, help)->check(CLI::Range(0.1, 10.0));
  };
  const auto flag = [&](bool& target, const char* help) {
    return verb.add_flag(name, target, help);
  };
  if (name == "--width")
    return value(
        to.width_text,
        "Width of the figure as 84mm, 8.4cm, 3.3in, 240pt or 992px, instead of --size; its "
        "layout follows");
  if (name == "--height")
    return value(to.height_text, "Its height, as --width; default: what it shows needs");
  if (name == "--font-size")
    return value(to.font_size_text,
                 "Size of type in legends and panels, as 8pt; with --width in mm, cm, in or pt by "
                 "default 8pt");
  if (name == "--dpi")
    return value(to.dpi, "Pixels an inch of --width and --font-size; default 300")
        ->check(CLI::Range(36.0, 2400.0));
  if (name == "--scale") return factor(to.scale, "Factor of all sizes: type, lines and signs");
  if (name == "--line-width") return factor(to.line_width, "Factor of the widths of lines");
  if (name == "--bare") return flag(to.bare, "Without title, legend and footer");
  if (name == "--no-title") return flag(to.no_title, "Without the title");
  if (name == "--no-legend") return flag(to.no_legend, "Without the legend");
  if (name == "--no-footer") return flag(to.no_footer, "Without source, frame and time");
  if (name == "--background")
    return value(to.background_text, "transparent, white or #RRGGBB; default: the theme's");
  if (name == "--theme") return value(to.theme_text, "Colours: light, dark, grey or print");
  if (name == "--words")
    return value(to.words, "TOML file with what stands in place of the words in pictures");
  if (name == "--font")
    return verb
        .add_option(name, to.fonts,
                    "TrueType file for characters that the own font lacks; or two, regular,bold")
        ->allow_extra_args(false)
        ->delimiter(',');
  return nullptr;
}

}  // namespace contactscope::app

#include "app/cli/figure_options.h"

#include <cstdio>
#include <ostream>

#include "app/cli/options.h"
#include "core/spell.h"
#include "draw/scene/layout.h"
#include "draw/scene/palette.h"
#include "image/font.h"

namespace contactscope::app {
namespace {

// Type size of a paper figure if only its width is set.
constexpr double kUsualType = 8;  // points
// The page already has margins; pixels at 720 lines.
constexpr double kFigureMargin = 2;
// Printed lines next to 8 point type are 0.5 to 1 point wide.
constexpr double kPaperLines = 0.65;
constexpr double kMinContrast = 4.5;  // of text with its background (WCAG 2.2, 1.4.3)

void check_ground(const draw::FigureStyle& style) {
  if (!style.background || style.background->a < 1) return;
  const draw::Color text =
      draw::themed(draw::kText, draw::ColorUse::Text, style.theme, *style.background);
  if (draw::contrast(text, *style.background) < kMinContrast)
    throw UsageError(std::string("--background is too ") +
                     (style.theme == draw::Theme::Dark
                          ? "light for --theme dark; leave the theme out"
                          : "dark for the text on it; add --theme dark"));
}

}  // namespace

void finish_figure(FigureOptions& figure, bool has_size) {
  if (figure.width && has_size)
    throw UsageError("--width and --size both set the width; leave out one");
  if (figure.height && !figure.width)
    throw UsageError("--height needs --width; write both, or --size WxH");
  const bool on_paper = figure.width && !figure.width->in_pixels;
  if (on_paper && !figure.font_size) figure.font_size = FigureLength{kUsualType};

  draw::FigureStyle& style = figure.style;
  style.scale = figure.scale;
  style.line_width = figure.line_width * (on_paper ? kPaperLines : 1);
  style.title = !figure.bare && !figure.no_title;
  style.legend = !figure.bare && !figure.no_legend;
  style.footer = !figure.bare && !figure.no_footer;
  if (figure.width) style.margin = kFigureMargin;
  if (on_paper || (figure.font_size && !figure.font_size->in_pixels))
    style.points_per_pixel = 72 / figure.dpi;
  if (figure.font_size) style.type = draw::type_of_em(figure.font_size->pixels(figure.dpi));
  style.theme = figure.theme;
  style.background = figure.background;
  check_ground(style);
  if (figure.fonts.size() > 2)
    throw UsageError("--font takes one file, or two with a comma between them: regular,bold");
  if (!figure.fonts.empty())
    add_font(figure.fonts[0], figure.fonts.size() > 1 ? figure.fonts[1] : std::string());
}

void MissingGlyphs::look(const draw::Drawing& drawing) {
  for (const draw::Primitive& primitive : drawing.primitives) {
    const auto* const text = std::get_if<draw::Text>(&primitive);
    if (text == nullptr) continue;
    for (const char32_t code : code_points(text->text)) {
      if (code >= 0x80 && !has_glyph(code, text->weight)) missing_.insert(code);
    }
  }
}

void MissingGlyphs::report(std::ostream& out) const {
  if (missing_.empty()) return;
  constexpr std::size_t kMax = 12;
  out << "no font has the character" << (missing_.size() == 1 ? "" : "s");
  std::size_t record = 0;
  for (const char32_t code : missing_) {
    if (record++ == kMax) break;
    out << ' ' << utf8_of(code) << printed(" (U+%04X)", static_cast<unsigned>(code));
  }
  if (missing_.size() > kMax) out << " and " << missing_.size() - kMax << " more";
  out << "; '?' stands for " << (missing_.size() == 1 ? "it" : "them")
      << ". Name a TrueType file that has " << (missing_.size() == 1 ? "it" : "them")
      << " with --font FILE\n";
}

}  // namespace contactscope::app

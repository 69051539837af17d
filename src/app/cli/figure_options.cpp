#include "app/cli/figure_options.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <ostream>

#include "app/cli/verbs.h"
#include "core/at.h"
#include "draw/scene/layout.h"
#include "draw/scene/palette.h"
#include "image/font.h"
#include "scenario/nearest_word.h"

namespace contactscope::app {
namespace {

// Type size of a paper figure if only its width is set.
constexpr double kUsualType = 8;  // points
// The page already has margins; pixels at 720 lines.
constexpr double kFigureMargin = 2;
// Printed lines next to 8 point type are 0.5 to 1 point wide.
constexpr double kPaperLines = 0.65;
constexpr double kMinContrast = 4.5;  // of text with its background (WCAG 2.2, 1.4.3)

FigureLength parse_length(const std::string& option, const std::string& text) {
  struct Unit {
    std::string_view name;
    double points;  // 0: pixels
  };
  constexpr std::array<Unit, 5> kUnits{
      {{"mm", 72 / 25.4}, {"cm", 720 / 25.4}, {"in", 72}, {"pt", 1}, {"px", 0}}};
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  for (const Unit& known : kUnits) {
    if (error != std::errc() || unit != known.name || !(value > 0) || value > 1e5) continue;
    return {known.points > 0 ? value * known.points : value, known.points == 0};
  }
  throw UsageError(option + " '" + text +
                   "' is no length; write a number and mm, cm, in, pt or px, as " +
                   (option == "--font-size" ? "8pt" : "84mm"));
}

draw::Color parse_background(const std::string& text) {
  if (text == "transparent") return {1, 1, 1, 0};
  if (text == "white") return draw::kWhite;
  unsigned hex = 0;
  const char* const begin = text.data() + 1;
  const char* const end = text.data() + text.size();
  if (text.size() == 7 && text[0] == '#' && std::from_chars(begin, end, hex, 16).ptr == end)
    return draw::rgb(hex);
  throw UsageError("--background '" + text +
                   "' is no colour; write transparent, white or #RRGGBB, as '#14171a'");
}

draw::Theme parse_theme(const std::string& text) {
  const std::vector<std::string_view> names(draw::kThemeNames.begin(), draw::kThemeNames.end());
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (text == names[i]) return static_cast<draw::Theme>(i);
  }
  throw UsageError("--theme '" + text + "' is not known; " + did_you_mean(text, names) +
                   "there is " + quoted_list(names));
}

std::string utf8_of(char32_t code) {
  const auto byte = [](char32_t bits) { return static_cast<char>(bits); };
  const auto tail = [&](int shift) { return byte(0x80 | ((code >> shift) & 0x3F)); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xC0 | code >> 6), tail(0)};
  if (code < 0x10000) return {byte(0xE0 | code >> 12), tail(6), tail(0)};
  return {byte(0xF0 | code >> 18), tail(12), tail(6), tail(0)};
}

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
  const auto read = [](const char* option, const std::string& text,
                       std::optional<FigureLength>& length) {
    if (!text.empty()) length = parse_length(option, text);
  };
  read("--width", figure.width_text, figure.width);
  read("--height", figure.height_text, figure.height);
  read("--font-size", figure.font_size_text, figure.font_size);
  if (figure.width && has_size) throw UsageError("--width and --size say the same; leave out one");
  if (figure.height && !figure.width)
    throw UsageError("--height goes with --width; write both, or --size WxH");
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
  if (!figure.theme_text.empty()) style.theme = parse_theme(figure.theme_text);
  if (!figure.background_text.empty()) style.background = parse_background(figure.background_text);
  check_ground(style);
  if (figure.fonts.size() > 2)
    throw UsageError("--font is one file, or two with a comma between: regular,bold");
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
    std::array<char, 16> number{};
    std::snprintf(number.data(), number.size(), "U+%04X", static_cast<unsigned>(code));
    out << ' ' << utf8_of(code) << " (" << number.data() << ')';
  }
  if (missing_.size() > kMax) out << " and " << missing_.size() - kMax << " more";
  out << "; '?' stands for " << (missing_.size() == 1 ? "it" : "them")
      << ". Name a TrueType file that has " << (missing_.size() == 1 ? "it" : "them")
      << " with --font FILE\n";
}

}  // namespace contactscope::app

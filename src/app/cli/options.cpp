#include "app/cli/options.h"

#include "app/cli/catalogue.h"
#include "draw/scene/palette.h"

namespace contactscope::app {
namespace {

/// Default root for scenario names: the installed scenarios replace a missing ./scenarios.
std::string scenario_root(const std::string& named) {
  std::error_code unknown;
  if (named != Options{}.scenario_root || std::filesystem::is_directory(named, unknown))
    return named;
  const std::string installed = installed_scenarios();
  return installed.empty() ? named : installed;
}

/// Validates the extra word of a file name.
void check_word(const Options& options) {
  const std::string& word = options.accept_as;
  if ((!word.empty() || !options.note.empty()) && !options.accept)
    throw UsageError("--as and --note need --accept");
  const bool is_plain =
      std::ranges::all_of(word, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!is_plain)
    throw UsageError("--as '" + word + "' is not a word; write letters, digits and _, as osmesa");
  if (!options.note.empty() && !word.starts_with("bad_"))
    throw UsageError("--note needs --as bad_WORD, the bug that it describes");
}

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

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

template <class Word, class Names>
std::vector<Word> parse_words(const std::string& option, const std::string& text,
                              const Names& names) {
  if (text == "none") return {};
  return mapped(split(text, ','), [&](std::string_view part) {
    const std::string name(part);
    if (name == "none") throw UsageError(option + " 'none' excludes all others; leave them out");
    return static_cast<Word>(word_in(option, name, {names.begin(), names.end()}));
  });
}

/// Checks options that depend on each other, sets `style` and opens the fonts. Throws UsageError,
/// FontError.
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

}  // namespace

void use_backend_of_environment(Options& options) {
  const char* const variable = std::getenv("CONTACTSCOPE_BACKEND");
  if (variable != nullptr && *variable != '\0')
    options.backend = parse_backend("$CONTACTSCOPE_BACKEND", variable);
}

void finish(Options& options) {
  options.scenario_root = scenario_root(options.scenario_root);
  finish_figure(options, options.size.has_value());
  if (!options.pair.empty() && options.pair.size() != 2)
    throw UsageError("--pair names two shapes, as --pair=crate,floor");
  if (options.out.empty()) throw UsageError("--out is empty; name a folder");
  if (options.write_missing && options.update == snapshot::Update::None)
    options.update = snapshot::Update::Missing;
  check_word(options);
}

std::size_t word_in(const std::string& option, const std::string& text,
                    const std::vector<std::string_view>& known) {
  const auto found = std::ranges::find(known, text);
  if (found != known.end()) return static_cast<std::size_t>(found - known.begin());
  throw UsageError(option + " '" + text + "' is not known; " + near_or_all(text, known));
}

FrameRange parse_frames(const std::string& option, const std::string& text) {
  const std::vector<std::string_view> parts = split(text, ':');
  std::vector<int> numbers;
  for (const std::string_view part : parts) {
    const std::optional<int> number = number_in<int>(part);
    if (!number || *number < 0)
      throw UsageError(option + " '" + text + "' is not a range; write A:B or A:B:STEP, as 0:23:4");
    numbers.push_back(*number);
  }
  const FrameRange range{numbers[0], numbers.size() > 1 ? numbers[1] : numbers[0],
                         numbers.size() > 2 ? numbers[2] : 1};
  if (numbers.size() > 3 || range.step < 1 || range.last < range.first) {
    throw UsageError(option + " '" + text +
                     "' is not a range; write A:B or A:B:STEP with A <= B and STEP >= 1");
  }
  return range;
}

Size parse_size(const std::string& option, const std::string& text) {
  constexpr int kMin = 64, kMax = 8192;  // supported by every OpenGL 3.3 driver
  const auto side = [](std::string_view part) {
    const int pixels = number_in<int>(part).value_or(0);
    return pixels >= kMin && pixels <= kMax ? pixels : 0;
  };
  const std::vector<std::string_view> parts = split(text, 'x');
  const Size size = parts.size() == 2 ? Size{side(parts[0]), side(parts[1])} : Size{0, 0};
  if (size.width > 0 && size.height > 0) return size;
  throw UsageError(option + " '" + text +
                   "' is not a size; write WxH with both between 64 and 8192, as 1280x720");
}

double parse_orthographic(const std::string& option, const std::string& text) {
  if (text == "fitted") return 0;
  const double height = number_in<double>(text).value_or(0);
  if (height > 0 && height < 1e9) return height;
  throw UsageError(option + "=" + text +
                   " is not a height; write --orthographic, or metres as --orthographic=1.5");
}

gl::Backend parse_backend(const std::string& option, const std::string& text) {
  return static_cast<gl::Backend>(word_in(option, text, {"auto", "egl", "osmesa"}));
}

snapshot::Update parse_update(const std::string& option, const std::string& text) {
  if (text == "never") return snapshot::Update::None;
  if (text == "failed") return snapshot::Update::Failed;
  if (text == "all") return snapshot::Update::All;
  throw UsageError(option + "=" + text + " is not known; write --update, --update=all or nothing");
}

snapshot::Shard parse_shard(const std::string& option, const std::string& text) {
  constexpr int kMax = 100000;
  int part = 0, of = 0, length = 0;
  const bool is_read = std::sscanf(text.c_str(), "%6d/%6d%n", &part, &of, &length) == 2;
  if (is_read && length == static_cast<int>(text.size()) && part >= 1 && part <= of && of <= kMax)
    return {part, of};
  throw UsageError(option + " '" + text + "' is not a part; write K/N with 1 <= K <= N, as 2/5");
}

std::vector<Layer> parse_layers(const std::string& option, const std::string& text) {
  return parse_words<Layer>(option, text, kLayerNames);
}

std::vector<Panel> parse_panels(const std::string& option, const std::string& text) {
  return parse_words<Panel>(option, text, kPanelNames);
}

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
                   "' is not a length; write a number and mm, cm, in, pt or px, as " +
                   (option == "--font-size" ? "8pt" : "84mm"));
}

draw::Color parse_background(const std::string& option, const std::string& text) {
  if (text == "transparent") return {1, 1, 1, 0};
  if (text == "white") return draw::kWhite;
  unsigned hex = 0;
  const char* const begin = text.data() + 1;
  const char* const end = text.data() + text.size();
  if (text.size() == 7 && text[0] == '#' && std::from_chars(begin, end, hex, 16).ptr == end)
    return draw::rgb(hex);
  throw UsageError(option + " '" + text +
                   "' is not a colour; write transparent, white or #RRGGBB, as '#14171a'");
}

draw::Theme parse_theme(const std::string& option, const std::string& text) {
  return static_cast<draw::Theme>(
      word_in(option, text, {draw::kThemeNames.begin(), draw::kThemeNames.end()}));
}

void MissingGlyphs::look(const draw::Drawing& drawing) {
  for (const draw::Primitive& primitive : drawing.primitives) {
    const auto* const text = std::get_if<draw::Text>(&primitive);
    if (text == nullptr) continue;
    for (const char32_t code : code_points(text->text))
      if (code >= 0x80 && !has_glyph(code, text->weight)) missing_.insert(code);
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

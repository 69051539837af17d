#pragma once

#include "draw/scene/drawing.h"
#include "trace/trace.h"
#include "view/view.h"
#include "view/words.h"

namespace contactscope::draw {

// theme.cpp: themes change the colours of a finished drawing and nothing else.

enum class Theme {
  Light,  // unchanged colours on white
  Dark,   // for dark slides
  Grey,   // for printers without colours: roles differ by lightness
  Print,  // black text, and no tint so light that a press loses it
};
inline constexpr std::array<std::string_view, 4> kThemeNames = {"light", "dark", "grey", "print"};

/// Use of a colour. Text needs more contrast with the ground than lines.
enum class ColorUse { Fill, Line, Text, Halo };

/// Background colour of a theme.
Color ground_of(Theme theme);

/// Converts a colour to a theme. White always becomes `ground`, because it represents an empty
/// background. Alpha changes only in the print theme, which strengthens faint colours.
Color themed(const Color& color, ColorUse use, Theme theme, const Color& ground);

/// Converts all colours of a drawing. `background` replaces the theme's ground. With alpha 0 the
/// background is transparent, and white becomes the theme's ground.
void apply_theme(Theme theme, const std::optional<Color>& background, Drawing& drawing);

/// Contrast of two opaque colours, 1 to 21 (WCAG 2.2, "contrast ratio").
double contrast(const Color& a, const Color& b);

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

inline constexpr double kLegendRow = 24;  // height, pixels at 720 lines
inline constexpr double kEntryGap = 22;   // between neighbouring texts

/// Places and sizes on a canvas. They scale from 1280 x 720, but text stays legible on small
/// pictures.
struct Layout {
  int width = 0, height = 0;
  float scale = 1;             // canvas pixels for one pixel at 720 lines
  Rect view{};                 // the 3D view
  Rect panels{};               // right column; zero width if the view has no panels
  Rect legend{};               // rows of the legend, under the view
  std::vector<Rect> insets{};  // next to the view, stacked, as large as the view together
  Rect page{};                 // the canvas without margins
  double title_size = 28;      // pixels at 720 lines
  int title_lines = 1;         // 0: no title
  bool footer = true;
  bool framed = false;           // a frame is drawn around the view
  bool ground = true;            // panels fill their background
  const Words* words = nullptr;  // translations for the drawings

  float px(double at_720) const { return scale * static_cast<float>(at_720); }
  /// Baseline of source and moment, a margin above the lower border; descenders reach below it.
  double footer_baseline() const;
};

/// `legend_widths`: widths of the legend's entries, for each picture of the sequence. The view then
/// has the same size in all frames. An empty title takes no room. The style outlives the layout.
Layout make_layout(int width, int height, bool has_panels,
                   const std::vector<std::vector<float>>& legend_widths, int insets = 0,
                   const FigureStyle& style = {}, const std::optional<std::string>& title = {});

/// Shortens text that is wider than `available` pixels with an ellipsis.
std::string fitted(const std::string& text, float size, FontWeight weight, float available);

/// Scale of text and lines on a canvas; 1 at 720 lines, or as a style sets it.
float interface_scale(int width, int height, const FigureStyle& style = {});

/// Pixels from ascender to descender of text whose em has this size. Font sizes in print are ems.
double type_of_em(double em_pixels);

/// A title broken into lines.
struct FittedTitle {
  std::vector<std::string> lines;  // one or two
  double size = 0;                 // of the text, pixels at 720 lines
};

/// Shrinks a title that is wider than `room` pixels, breaks it into two lines if it would get too
/// small, and shortens it with an ellipsis if two lines are too narrow.
FittedTitle fit_title(const std::string& title, float room, float scale);

/// Title top left, source bottom left, frame and time bottom right.
void draw_captions(const std::string& title, const std::string& source, const std::string& moment,
                   const Layout& layout, Drawing& drawing);

/// Texts for the moment of a frame: "frame 12, t = 0.200 s", or "step 3 of 5" for an algorithm
/// shown in steps. Frame k of an algorithm shows the result of step k; frame 0 is the start. If the
/// time equals the frame number, frames are pictures, and the first is picture 1.
class Moments {
 public:
  /// Without frames: texts with frame and time.
  Moments() = default;
  /// All frames of a sequence, or a subset of a long one that includes the first and the last.
  Moments(const std::vector<trace::Frame>& frames, Story story);

  std::string of(const trace::Frame& frame) const;

 private:
  bool steps_ = false;
  const char* word_ = "step";
  int before_first_ = 0;  // added to the number of a frame
  int last_ = 0;          // last step
};

}  // namespace contactscope::draw

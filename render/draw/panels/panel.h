#pragma once

#include "draw/staging.h"

/// Panels next to a picture: rows of text, charts and maps, made from the trace alone and laid out
/// on a sheet as primitives. The caller places the sheets and draws the frames around them.
namespace contactscope::draw {

/// Padding between a panel and its sheet on each side, pixels at 720 lines.
inline constexpr float kPanelPadding = 12;

/// Rows of text on a panel, from top to bottom, in the embedded fonts. Text that is too wide is
/// shortened with an ellipsis or wrapped.
class Sheet {
 public:
  /// `rect`: the area inside the panel's padding; `scale`: pixels for one pixel at 720 lines.
  Sheet(const Rect& rect, float scale, Drawing& drawing);

  /// Bold text with a thin rule below.
  void heading(const std::string& text);
  /// Enlarges the following rows, so that a panel with enough room is legible on a slide as well.
  void enlarge(double times);
  void line(const std::string& text, const Color& color);
  void paragraph(const std::string& text, const Color& color);
  /// Name and value in two columns.
  void row(const std::string& name, const std::string& value);
  /// Moves down by this height. Rows start on whole pixels.
  void skip(float pixels);
  /// Continues at this height of the canvas.
  void skip_to(double y) { y_ = static_cast<float>(y); }
  /// Writes "and 2 more pairs" and returns "2 pairs"; does nothing for 0.
  std::string more(std::size_t count, const char* one, const char* many);
  /// Writes why there is nothing to show, and returns that nothing is missing.
  std::string inapplicable(const std::string& reason);

  /// The area below the last row.
  Rect rest() const;
  const Pen& pen() const { return pen_; }
  float text_height() const { return text_; }
  /// Distance between two rows.
  float line_height() const { return text_ + spacing_; }

  /// For a panel at this scale, pixels.
  static float line_height(float scale);
  static float heading_height(float scale);
  /// Number of lines of a row's value on a sheet of this width, pixels, after translation.
  static std::size_t row_lines(const std::string& value, float width, float scale,
                               const Words* words);

 private:
  void write(const std::vector<std::string>& lines, float x, const Color& color);

  Rect rect_;
  Pen pen_;
  float text_, spacing_;  // pixels
  float y_;               // of the next row
};

/// Wraps text to this width.
std::vector<std::string> wrapped(const std::string& text, float size, float width);

/// One picture of a sequence. Pipeline times are set on request only: they make every picture
/// differ.
struct PanelMoment {
  std::size_t frame = 0;                 // index into the frames
  const trace::Frame* before = nullptr;  // the frame before, if it is not among the frames
  std::optional<double> pipeline_nanoseconds{};
};

/// Heights of a panel in a column, pixels.
struct PanelNeed {
  float least = 0;   // minimum: the panel is useless below
  float good = 0;    // from here on nothing is left out; at least `least`
  float wanted = 0;  // maximum useful height; 0: a share of the remaining height
  float share = 0;   // share among panels with `wanted` 0
};

using Frames = std::vector<trace::Frame>;  // of a whole sequence

/// Content of one panel for a sequence. It reads the frames once, when it is made or first laid
/// out. After that the cost of a picture depends only on what it shows.
class PanelContent {
 public:
  /// Staging and frames outlive the content.
  PanelContent(const Staging& staging, const Frames& frames)
      : staging_(staging), frames_(frames), scale_(staging.layout.scale) {}
  virtual ~PanelContent() = default;

  /// Heights for the sheet. They are equal in all frames of a sequence with the same pairs.
  virtual PanelNeed need(const PanelMoment& moment) const = 0;

  /// Fills the sheet. Returns a description of what did not fit, "2 pairs", or an empty string.
  virtual std::string lay_out(const PanelMoment& moment, Sheet& sheet) = 0;

 protected:
  /// For a heading, lines of text and a chart of these heights, with `around` it; pixels at 720.
  PanelNeed need_of(double least, double good, double wanted, double around, int lines = 0) const {
    const auto high = [&](double chart) {
      return Sheet::heading_height(scale_) +
             static_cast<float>(lines) * Sheet::line_height(scale_) +
             static_cast<float>(chart + around) * scale_;
    };
    return {high(least), high(good), high(wanted), 0};
  }

  const Staging& staging_;
  const Frames& frames_;
  const float scale_;  // pixels for one pixel at 720 lines
};

struct FilledPanel {
  Panel panel;
  std::unique_ptr<PanelContent> content;
};

/// The panels of the staged view, except insets. Staging and frames outlive them.
std::vector<FilledPanel> make_panels(const Staging& staging, const Frames& frames);

/// Divides a column among its panels. Returns a height for each, in order, 0 for panels without
/// room. All get their minimum. The remaining height first raises panels to `good` and then to
/// `wanted`, in order; panels with `wanted` 0 divide the rest by their shares, and none shrinks. If
/// the minimum heights do not fit, the last panels are left out, and `note` pixels are reserved
/// below for a line about it. The first panel always gets room, cut to the column. `gap`: between
/// two panels.
std::vector<float> divide_column(const std::vector<PanelNeed>& needs, float height, float gap,
                                 float note);

/// The parts of a panel except its name: the stages it needs, and its content, which an inset does
/// not have. It is defined in the panel's file, or in sheet.cpp for insets.
struct PanelDrawing {
  std::array<bool Stages::*, 3> needs{};
  std::unique_ptr<PanelContent> (*make)(const Staging&, const Frames&) = nullptr;
};

template <class Content>
std::unique_ptr<PanelContent> make_panel(const Staging& staging, const Frames& frames) {
  return std::make_unique<Content>(staging, frames);
}

#define CONTACTSCOPE_DECLARE(panel, name) extern const PanelDrawing k##panel##Panel;
CONTACTSCOPE_PANELS(CONTACTSCOPE_DECLARE)
#undef CONTACTSCOPE_DECLARE

/// One entry for each Panel, in order.
#define CONTACTSCOPE_ENTRY(panel, name) &k##panel##Panel,
inline constexpr std::array<const PanelDrawing*, kPanelNames.size()> kPanels = {
    CONTACTSCOPE_PANELS(CONTACTSCOPE_ENTRY)};
#undef CONTACTSCOPE_ENTRY

}  // namespace contactscope::draw

#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "draw/scene/pen.h"
#include "draw/staging.h"

/// Panels beside a picture are content: rows of text, charts and maps, made from facts of the trace
/// alone and laid out on a sheet as primitives. Where the sheets stand, and what is around them,
/// others say.
namespace contactscope::draw {

/// Between a panel and its sheet, on either side; pixels at 720 lines.
inline constexpr float kPanelPadding = 12;

/// Rows of text on a panel, from the top down, in the embedded fonts. What is too wide is cut with
/// an ellipsis, or goes on in another line.
class Sheet {
 public:
  /// `rect`: what is inside of the panel's padding; `scale`: pixels for one at 720 lines.
  Sheet(const Rect& rect, float scale, Drawing& drawing);

  /// In bold, with a thin rule under it.
  void heading(const std::string& text);
  /// Rows from here on are so many times as large: where a panel has room, what it says is legible
  /// on a slide as well.
  void enlarge(double times);
  void line(const std::string& text, const Color& color) { lines({text}, color); }
  /// Close under each other.
  void lines(const std::vector<std::string>& all, const Color& color);
  void paragraph(const std::string& text, const Color& color);
  /// Names in a column of their own, left of the values.
  void row(const std::string& name, const std::string& value);
  /// Moves down past something this high. Rows begin on whole pixels.
  void skip(float pixels);
  /// Goes on at this height of the canvas.
  void skip_to(double y) { y_ = static_cast<float>(y); }
  /// "and 2 more pairs"; of none nothing. Returns "2 pairs".
  std::string more(std::size_t count, const char* one, const char* many);

  /// What is left under the last row.
  Rect rest() const;
  const Pen& pen() const { return pen_; }
  float text_height() const { return text_; }
  /// From a row to the next.
  float line_height() const { return text_ + spacing_; }

  /// Of a panel at this scale, pixels.
  static float line_height(float scale);
  static float heading_height(float scale);
  /// Lines that the value of a row takes on a sheet so wide, pixels, in the words of its reader.
  static std::size_t row_lines(const std::string& value, float width, float scale,
                               const Words* words);

 private:
  void write(const std::vector<std::string>& lines, float x, const Color& color);

  Rect rect_;
  Pen pen_;
  float text_, spacing_;  // pixels
  float y_;               // of the next row
};

/// Words in as many lines as they take at this width.
std::vector<std::string> wrapped(const std::string& text, float size, float width);

/// One picture of a sequence. The pipeline's time is there when somebody asked for it: a measured
/// time makes every picture differ.
struct PanelMoment {
  std::size_t frame = 0;  // index into the frames
  std::optional<double> pipeline_nanoseconds{};
};

/// How high one panel of a column must, can and would be, in pixels.
struct PanelNeed {
  float least = 0;   // below this it says nothing
  float good = 0;    // at which nothing that it shows is left out; not below `least`
  float wanted = 0;  // where it has no use for more; 0: it takes its share of what is left
  float share = 0;   // of what panels without a wanted height divide
};

/// What one panel shows of a sequence. It looks through the frames once, when it is made or first
/// laid out; after that a picture costs what it shows.
class PanelContent {
 public:
  virtual ~PanelContent() = default;

  /// How high the sheet must, can and would be; the same in every frame of a sequence with the same
  /// pairs.
  virtual PanelNeed need(const PanelMoment& moment) const = 0;

  /// Fills the sheet. Returns what it has no room for, "2 pairs", or nothing.
  virtual std::string lay_out(const PanelMoment& moment, Sheet& sheet) = 0;
};

using Frames = std::vector<trace::Frame>;  // of a whole sequence

struct FilledPanel {
  Panel panel;
  std::unique_ptr<PanelContent> content;
};

/// The panels that the staged view names, but for those that are insets. Staging and frames outlive
/// them.
std::vector<FilledPanel> make_panels(const Staging& staging, const Frames& frames);

/// Divides a column among its panels: a height for each, in their order, 0 for those that have no
/// room. Each gets its least height; from what is left first the good ones are reached and then the
/// wanted ones, in order; the others divide the rest by their shares, none less than it has. Where
/// even the least heights do not fit, the last panels are left out, and `note` pixels are kept below
/// the others for a line that says so. The first panel is always there, cut to the column. `gap`:
/// between two panels.
std::vector<float> divide_column(const std::vector<PanelNeed>& needs, float height, float gap,
                                 float note);

// The panels, one file each.
using MakePanel = std::unique_ptr<PanelContent>(const Staging&, const Frames&);
MakePanel make_summary_panel, make_contact_plane_panel, make_axis_history_panel;
MakePanel make_stability_panel, make_plots_panel, make_pipeline_panel, make_endpoints_panel;
MakePanel make_node_pairs_panel, make_tree_cost_panel;
MakePanel make_axis_intervals_panel, make_answers_panel, make_approach_panel;

}  // namespace contactscope::draw

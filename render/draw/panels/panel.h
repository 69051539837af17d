#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "draw/panels/sheet.h"
#include "draw/staging.h"

/// Panels beside a picture are content: rows of text, charts and maps, made from facts of the trace
/// alone and laid out on a sheet as primitives. Where the sheets stand, and what is around them,
/// others say.
namespace contactscope::draw {

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
MakePanel make_stability_panel, make_plots_panel;

}  // namespace contactscope::draw

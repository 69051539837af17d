#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/layers.h"
#include "draw/panels/column.h"
#include "draw/panels/sheet.h"
#include "draw/staging.h"
#include "trace/trace.h"

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

// The panels, one file each.
std::unique_ptr<PanelContent> make_summary_panel(const Staging& staging, const Frames& frames);
std::unique_ptr<PanelContent> make_contact_plane_panel(const Staging& staging,
                                                       const Frames& frames);
std::unique_ptr<PanelContent> make_axis_history_panel(const Staging& staging, const Frames& frames);
std::unique_ptr<PanelContent> make_stability_panel(const Staging& staging, const Frames& frames);
std::unique_ptr<PanelContent> make_plots_panel(const Staging& staging, const Frames& frames);

}  // namespace contactscope::draw

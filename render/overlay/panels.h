#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/staging.h"
#include "overlay/panel_heights.h"
#include "trace/trace.h"

namespace contactscope::overlay {

/// What the panels of one picture show. Everything comes from the trace; `pipeline_nanoseconds` is
/// measured by the caller when somebody asked for it, and absent otherwise, because a measured time
/// would make every picture differ.
struct PanelFacts {
  const draw::Staging& staging;
  const std::vector<trace::Frame>& frames;  // the whole sequence
  std::size_t current = 0;                  // index into frames
  std::optional<double> pipeline_nanoseconds;
};

/// Issues the Dear ImGui windows of the view's panels, stacked in the layout's panel column. Called
/// between the renderer's begin_frame and end_frame. A name that is no panel is passed over; the
/// scenario reader has refused it already. Returns what the column has no room for, "panel plots"
/// or "2 pairs of panel summary"; the picture says it too.
std::vector<std::string> draw_panels(const PanelFacts& facts);

// The panels, one file each. They draw into the current window; `height` is theirs to fill, pixels.
// Those that may leave something out return what they had no room for, "2 pairs", or nothing.
std::string summary_panel(const PanelFacts& facts, float height);
void contact_plane_panel(const PanelFacts& facts, float height);
std::string axis_history_panel(const PanelFacts& facts, float height);
void stability_panel(const PanelFacts& facts, float height);
std::string plots_panel(const PanelFacts& facts, float height);

// What they need, padding and heading included; the same in every frame of a sequence with the same
// pairs.
PanelNeed summary_need(const PanelFacts& facts);
PanelNeed contact_plane_need(const PanelFacts& facts);
PanelNeed axis_history_need(const PanelFacts& facts);
PanelNeed stability_need(const PanelFacts& facts);
PanelNeed plots_need(const PanelFacts& facts);

}  // namespace contactscope::overlay

#pragma once

#include <optional>
#include <vector>

#include "draw/staging.h"
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
/// scenario reader has refused it already.
void draw_panels(const PanelFacts& facts);

// The panels, one file each. They draw into the current window; `height` is theirs to fill, pixels.
void summary_panel(const PanelFacts& facts);
void contact_plane_panel(const PanelFacts& facts, float height);
void axis_history_panel(const PanelFacts& facts, float height);
void stability_panel(const PanelFacts& facts, float height);
void plots_panel(const PanelFacts& facts, float height);

/// Height in pixels that the summary needs.
float summary_height(const PanelFacts& facts);

}  // namespace contactscope::overlay

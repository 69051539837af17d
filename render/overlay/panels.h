#pragma once

#include <string>
#include <vector>

#include "draw/panels/panel.h"
#include "draw/scene/drawing.h"
#include "draw/staging.h"
#include "trace/trace.h"

namespace contactscope::overlay {

/// The panels of one sequence, stacked in the layout's column: each in a Dear ImGui window, which
/// says where its content goes. Staging and frames outlive it.
class PanelColumn {
 public:
  PanelColumn(const draw::Staging& staging, const std::vector<trace::Frame>& frames);

  /// Issues the windows of one picture, between the renderer's begin_frame and end_frame, and adds
  /// what they show to `contents`, to be painted after them. Returns what the column has no room
  /// for, "panel plots" or "2 pairs of panel summary"; the picture says it too.
  std::vector<std::string> lay_out(const draw::PanelMoment& moment, draw::Drawing& contents) const;

 private:
  const draw::Layout& layout_;
  std::vector<draw::FilledPanel> panels_;
};

}  // namespace contactscope::overlay

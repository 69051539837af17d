#pragma once

#include <string>
#include <vector>

#include "draw/panels/panel.h"
#include "draw/scene/drawing.h"
#include "draw/staging.h"
#include "overlay/imgui_windows.h"
#include "trace/trace.h"

namespace contactscope::overlay {

/// The panels of one sequence, stacked in the layout's column: each in a Dear ImGui window, which
/// says where its content goes. Staging and frames outlive it.
class PanelColumn {
 public:
  PanelColumn(const draw::Staging& staging, const std::vector<trace::Frame>& frames);

  /// Adds the panels of one picture. Returns what the column has no room for, "panel plots" or "2
  /// pairs of panel summary"; the picture says it too.
  std::vector<std::string> add(const draw::PanelMoment& moment, draw::Drawing& drawing);

 private:
  const draw::Layout& layout_;
  std::vector<draw::FilledPanel> panels_;
  Windows windows_;
};

}  // namespace contactscope::overlay

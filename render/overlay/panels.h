#pragma once

#include <string>
#include <vector>

#include "draw/panels/panel.h"
#include "draw/scene/drawing.h"
#include "draw/staging.h"
#include "trace/trace.h"

struct ImGuiContext;

namespace contactscope::overlay {

/// Dear ImGui for the windows of panels: a context of its own that knows no input, clock or file, so
/// that equal calls give equal windows. It says where windows stand, how their padding and stacking
/// are, and what they are painted with; the painting itself becomes primitives as everything else,
/// so that no pixel depends on the version of Dear ImGui.
///
/// Shapes of one colour are supported; text and images are not: what stands in a window is a
/// draw::Drawing of its own. Use one object for one sequence, on one thread (Dear ImGui's current
/// context is global).
class Windows {
 public:
  /// White, without borders, on a canvas of this size. `scale` multiplies padding; 1 suits 720 lines.
  Windows(int width, int height, float scale);
  ~Windows();
  Windows(const Windows&) = delete;
  Windows& operator=(const Windows&) = delete;

  /// Makes this ImGui context the current one and opens a frame of 1/60 s.
  void begin_frame();
  /// Closes the frame and adds its windows, those in the back first.
  void end_frame(draw::Drawing& drawing);

 private:
  ImGuiContext* imgui_;
};

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

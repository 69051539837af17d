#pragma once

#include "draw/panels/panel.h"

struct ImGuiContext;

namespace contactscope::overlay {

/// A Dear ImGui context for the windows of panels, without input, clock or files, so that equal
/// calls give equal windows. It determines position, padding, stacking and background of windows.
/// They are painted as primitives, so pixels do not depend on the version of Dear ImGui.
///
/// Supports shapes of one colour, but no text or images: content of a window is a separate
/// draw::Drawing. Use one object per sequence, on one thread (Dear ImGui's current context is
/// global).
class Windows {
 public:
  /// White, without borders, on a canvas of this size. `scale` multiplies padding; 1: 720 lines.
  Windows(int width, int height, float scale);
  ~Windows();
  Windows& operator=(Windows&&) = delete;

  /// Makes this ImGui context current and starts a frame of 1/60 s.
  void begin_frame();
  /// Ends the frame and adds its windows, back to front.
  void end_frame(draw::Drawing& drawing);

 private:
  ImGuiContext* imgui_;
};

/// Panels of a sequence, stacked in the layout's column. Dear ImGui windows determine the position
/// of their contents. Staging and frames must outlive it.
class PanelColumn {
 public:
  PanelColumn(const draw::Staging& staging, const std::vector<trace::Frame>& frames);

  /// Makes the panels again, because the frames have changed.
  void renew(const draw::Staging& staging, const std::vector<trace::Frame>& frames);

  /// Adds the panels of one picture. Returns what does not fit, "panel plots" or "2 pairs of panel
  /// summary"; the picture notes it too.
  std::vector<std::string> add(const draw::PanelMoment& moment, draw::Drawing& drawing);

 private:
  const draw::Layout& layout_;
  std::vector<draw::FilledPanel> panels_;
  Windows windows_;
};

}  // namespace contactscope::overlay

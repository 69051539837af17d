#include <imgui.h>

#include "draw/series_plots.h"
#include "draw/stability_plot.h"
#include "overlay/paint.h"
#include "overlay/panels.h"

namespace contactscope::overlay {
namespace {

/// What is left of a panel of this height under its heading.
draw::Rect rest_of_panel(float height, float top) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  return {corner.x, corner.y, ImGui::GetContentRegionAvail().x,
          height - (ImGui::GetCursorPosY() - top)};
}

}  // namespace

// Whether the centre of mass projects into the manifold, by what margin, and over time.
void stability_panel(const PanelFacts& facts, float height) {
  const float scale = facts.staging.layout.scale;
  const float top = ImGui::GetCursorPosY();
  heading("stability: centre of mass over the contact", scale);
  draw::Drawing drawing;
  draw::draw_stability(facts.frames, facts.current, facts.staging.camera,
                       rest_of_panel(height, top), scale, drawing);
  paint(drawing, ImGui::GetWindowDrawList());
}

// What the solver made of it, up to the current frame.
void plots_panel(const PanelFacts& facts, float height) {
  const float scale = facts.staging.layout.scale;
  const float top = ImGui::GetCursorPosY();
  heading("over time", scale);
  draw::Drawing drawing;
  draw::draw_series_plots(draw::time_series(facts.frames), facts.current, facts.frames.back().time,
                          rest_of_panel(height, top), scale, drawing);
  paint(drawing, ImGui::GetWindowDrawList());
}

}  // namespace contactscope::overlay

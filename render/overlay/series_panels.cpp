#include <imgui.h>

#include <algorithm>

#include "draw/charts/series_plots.h"
#include "draw/insets/stability_plot.h"
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

// Pixels at 720 lines, of what the drawings below need.
constexpr double kStabilityWords = 65;  // lines under the map, and the name over it
constexpr double kStabilityMap = 70;
constexpr double kStabilityOverTime = 64;
constexpr double kPlotsAxis = 40;  // of time, and a row of names
constexpr double kPlotsChart = 46;

}  // namespace

PanelNeed stability_need(const PanelFacts& facts) {
  const draw::Layout& layout = facts.staging.layout;
  const float least =
      panel_frame() + heading_height(layout.scale) + layout.px(kStabilityWords + kStabilityMap);
  return {least, least + layout.px(kStabilityOverTime), 0, 2};
}

PanelNeed plots_need(const PanelFacts& facts) {
  const draw::Layout& layout = facts.staging.layout;
  const bool solved = std::ranges::any_of(
      facts.frames, [](const trace::Frame& frame) { return frame.solver.has_value(); });
  const int charts = solved ? 4 : 2;
  const float least =
      panel_frame() + heading_height(layout.scale) + layout.px(kPlotsAxis + kPlotsChart);
  return {least, least + layout.px((charts - 1) * kPlotsChart), 0, 2};
}

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
std::string plots_panel(const PanelFacts& facts, float height) {
  const float scale = facts.staging.layout.scale;
  const float top = ImGui::GetCursorPosY();
  heading("over time", scale);
  draw::Drawing drawing;
  const bool shows_loads = facts.staging.view.shows(Layer::Loads);
  const std::vector<draw::TimeSeries> series = draw::time_series(facts.frames);
  const auto painted = [&](draw::Drawing& out, float room) {
    return draw::draw_series_plots(series, facts.current, facts.frames.back().time,
                                   rest_of_panel(room, top), scale, out,
                                   shows_loads ? facts.staging.scales.step : 0);
  };
  std::size_t missing = painted(drawing, height);
  if (missing > 0) {  // again, with a line below that says so
    drawing = {};
    const float line = ImGui::GetTextLineHeightWithSpacing();
    missing = painted(drawing, height - line);
    ImGui::SetCursorPosY(top + height - line);
  }
  paint(drawing, ImGui::GetWindowDrawList());
  return more(missing, "chart", "charts");
}

}  // namespace contactscope::overlay

#include "overlay/panels.h"

#include <imgui.h>

#include <algorithm>
#include <iterator>
#include <string>

#include "draw/scene/palette.h"
#include "overlay/paint.h"

namespace contactscope::overlay {

void heading(const char* text, float scale) {
  ImFont* bold = ImGui::GetIO().Fonts->Fonts.back();
  ImGui::PushFont(bold);
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::GetWindowDrawList()->AddLine(from, {from.x + width, from.y},
                                      packed(draw::with_alpha(draw::kQuietText, 0.5f)), scale);
  ImGui::Dummy({width, 4 * scale});
}

void centered_text(ImDrawList* list, ImVec2 at, const draw::Color& color, const char* text) {
  const ImVec2 size = ImGui::CalcTextSize(text);
  list->AddText({at.x - 0.5f * size.x, at.y - 0.5f * size.y}, packed(color), text);
}

float heading_height(float scale) {
  const float spacing = ImGui::GetStyle().ItemSpacing.y;
  return ImGui::GetIO().Fonts->Fonts.back()->FontSize + 4 * scale + 2 * spacing;
}

float panel_frame() {
  return 2 * ImGui::GetStyle().WindowPadding.y;
}

std::string more(std::size_t count, const char* one, const char* many) {
  if (count == 0) return {};
  const char* const noun = count == 1 ? one : many;
  ImGui::TextColored(ImColor(packed(draw::kQuietText)), "and %zu more %s", count, noun);
  return std::to_string(count) + " " + noun;
}

namespace {

struct PanelRow {
  Panel panel;
  PanelNeed (*need)(const PanelFacts&);
  std::string (*draw)(const PanelFacts&, float);  // returns what it has no room for
};

template <void (*kDraw)(const PanelFacts&, float)>
std::string whole(const PanelFacts& facts, float height) {
  kDraw(facts, height);
  return {};
}

constexpr PanelRow kPanels[] = {
    {Panel::Summary, summary_need, summary_panel},
    {Panel::ContactPlane, contact_plane_need, whole<contact_plane_panel>},
    {Panel::AxisHistory, axis_history_need, axis_history_panel},
    {Panel::Stability, stability_need, whole<stability_panel>},
    {Panel::Plots, plots_need, plots_panel},
};

/// Under the panels that have room.
void name_left_out(const std::vector<const PanelRow*>& panels, const draw::Layout& layout,
                   float y) {
  std::string text = "no room for";
  for (const PanelRow* panel : panels) {
    text += (panel == panels.front() ? " " : ", ") + std::string(name_of(panel->panel));
  }
  const float size = ImGui::GetFontSize();
  text = draw::fitted(text, size, FontWeight::Regular, static_cast<float>(layout.panels.width));
  ImGui::GetForegroundDrawList()->AddText({static_cast<float>(layout.panels.x), y},
                                          packed(draw::kQuietText), text.c_str());
}

}  // namespace

std::vector<std::string> draw_panels(const PanelFacts& facts) {
  const draw::Layout& layout = facts.staging.layout;
  const float gap = layout.px(12);
  std::vector<const PanelRow*> panels;
  std::vector<PanelNeed> needs;
  for (const Panel word : facts.staging.view.panels) {
    const auto* const panel = std::ranges::find(kPanels, word, &PanelRow::panel);
    if (panel == std::end(kPanels)) continue;
    panels.push_back(panel);
    needs.push_back(panel->need(facts));
  }
  const std::vector<float> heights = divide_column(needs, static_cast<float>(layout.panels.height),
                                                   gap, ImGui::GetTextLineHeightWithSpacing());

  std::vector<std::string> left_out;
  std::vector<const PanelRow*> without_room;
  float y = static_cast<float>(layout.panels.y);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const PanelRow& panel = *panels[i];
    const std::string name(name_of(panel.panel));
    if (heights[i] <= 0) {
      left_out.push_back("panel " + name);
      without_room.push_back(&panel);
      continue;
    }
    ImGui::SetNextWindowPos({static_cast<float>(layout.panels.x), y});
    ImGui::SetNextWindowSize({static_cast<float>(layout.panels.width), heights[i]});
    ImGui::Begin(name.c_str(), nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove);
    const std::string missing = panel.draw(facts, heights[i] - panel_frame());
    if (!missing.empty()) left_out.push_back(missing + " of panel " + name);
    ImGui::End();
    y += heights[i] + gap;
  }
  if (!without_room.empty()) name_left_out(without_room, layout, y - gap + layout.px(4));
  return left_out;
}

}  // namespace contactscope::overlay

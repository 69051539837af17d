#include "overlay/panels.h"

#include <imgui.h>

#include <algorithm>

#include "draw/palette.h"
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

void draw_panels(const PanelFacts& facts) {
  const draw::Layout& layout = facts.staging.layout;
  const std::vector<std::string>& names = facts.staging.view.panels;
  const float gap = layout.px(12);

  // The summary takes what it needs, the others share the rest; a history is half as high as a map.
  const auto share = [](const std::string& name) {
    return name == "summary" ? 0.0f : name == "axis_history" ? 1.0f : 2.0f;
  };
  float shares = 0;
  float free_height = static_cast<float>(layout.panels.height) + gap;
  for (const std::string& name : names) {
    shares += share(name);
    free_height -= gap;
    if (name == "summary") free_height -= summary_height(facts);
  }

  float y = static_cast<float>(layout.panels.y);
  for (const std::string& name : names) {
    const float bottom = static_cast<float>(layout.panels.y + layout.panels.height);
    const float wanted = name == "summary"
                             ? summary_height(facts)
                             : std::max(layout.px(60), free_height * share(name) / shares);
    const float height = std::min(wanted, bottom - y);
    if (height < layout.px(40)) return;  // a small picture has no room for more
    ImGui::SetNextWindowPos({static_cast<float>(layout.panels.x), y});
    ImGui::SetNextWindowSize({static_cast<float>(layout.panels.width), height});
    ImGui::Begin(name.c_str(), nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove);
    if (name == "summary") summary_panel(facts);
    const float inner = height - 2 * ImGui::GetStyle().WindowPadding.y;
    if (name == "contact_plane") contact_plane_panel(facts, inner);
    if (name == "axis_history") axis_history_panel(facts, inner);
    if (name == "stability") stability_panel(facts, inner);
    if (name == "plots") plots_panel(facts, inner);
    ImGui::End();
    y += height + gap;
  }
}

}  // namespace contactscope::overlay

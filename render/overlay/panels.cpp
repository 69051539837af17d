#include "overlay/panels.h"

#include <imgui.h>

#include "draw/scene/palette.h"

namespace contactscope::overlay {
namespace {

constexpr double kBetweenPanels = 12;  // pixels at 720 lines

struct Window {
  draw::Rect outer, inner;  // with and without its padding
};

Window open_window(const std::string& name, const ImVec2& corner, const ImVec2& size) {
  ImGui::SetNextWindowPos(corner);
  ImGui::SetNextWindowSize(size);
  ImGui::Begin(name.c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove);
  const auto rect = [](const ImVec2& at, const ImVec2& extent) {
    return draw::Rect{at.x, at.y, extent.x, extent.y};
  };
  const Window window{rect(ImGui::GetWindowPos(), ImGui::GetWindowSize()),
                      rect(ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail())};
  ImGui::End();
  return window;
}

/// A line one pixel wide, on the outermost pixels of a window.
void draw_border(const draw::Rect& outer, const draw::Pen& pen) {
  const draw::Rect middle{outer.x + 0.5, outer.y + 0.5, outer.width - 1, outer.height - 1};
  pen.frame(middle, 1 / pen.scale(), draw::with_alpha(draw::kQuietText, 0.35f));
}

draw::PanelNeed with_padding(draw::PanelNeed need) {
  const float around = 2 * ImGui::GetStyle().WindowPadding.y;
  need.least += around;
  need.good += around;
  if (need.wanted > 0) need.wanted += around;
  return need;
}

}  // namespace

PanelColumn::PanelColumn(const draw::Staging& staging, const std::vector<trace::Frame>& frames)
    : layout_(staging.layout),
      panels_(draw::make_panels(staging, frames)),
      windows_(layout_.width, layout_.height, layout_.scale) {}

std::vector<std::string> PanelColumn::add(const draw::PanelMoment& moment, draw::Drawing& drawing) {
  draw::Drawing contents;
  windows_.begin_frame();
  std::vector<draw::PanelNeed> needs;
  for (const draw::FilledPanel& panel : panels_)
    needs.push_back(with_padding(panel.content->need(moment)));
  const draw::Rect& column = layout_.panels;
  const float gap = layout_.px(kBetweenPanels);
  const std::vector<float> heights = draw::divide_column(
      needs, static_cast<float>(column.height), gap, draw::Sheet::line_height(layout_.scale));

  const auto left = static_cast<float>(column.x), width = static_cast<float>(column.width);
  auto y = static_cast<float>(column.y);
  std::vector<std::string> left_out;
  std::string without_room;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    const std::string name(name_of(panels_[i].panel));
    if (heights[i] <= 0) {
      left_out.push_back("panel " + name);
      without_room += (without_room.empty() ? "no room for " : ", ") + name;
      continue;
    }
    const Window window = open_window(name, {left, y}, {width, heights[i]});
    draw::Sheet sheet(window.inner, layout_.scale, contents);
    draw_border(window.outer, sheet.pen());
    const std::string missing = panels_[i].content->lay_out(moment, sheet);
    if (!missing.empty()) left_out.push_back(missing + " of panel " + name);
    y += heights[i] + gap;
  }
  if (!without_room.empty()) {
    draw::Sheet(draw::Rect{column.x, y - gap + layout_.px(4), column.width, column.height},
                layout_.scale, contents)
        .line(without_room, draw::kQuietText);
  }
  windows_.end_frame(drawing);
  drawing.primitives.insert(drawing.primitives.end(), contents.primitives.begin(),
                            contents.primitives.end());
  return left_out;
}

}  // namespace contactscope::overlay

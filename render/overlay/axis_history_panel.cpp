#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "draw/palette.h"
#include "overlay/paint.h"
#include "overlay/panels.h"

namespace contactscope::overlay {
namespace {

struct Row {
  const char* axis;
  const char* name;
};
constexpr std::array<Row, 3> kRows{
    {{"face_a", "face A"}, {"face_b", "face B"}, {"edge_edge", "edges"}}};

int switches(const PanelFacts& facts, std::size_t pair) {
  int count = 0;
  std::string last;
  for (std::size_t f = 0; f <= facts.current; ++f) {
    const auto& sat = facts.frames[f].pairs[pair].sat;
    if (!sat) continue;
    if (!last.empty() && sat->chosen != last) ++count;
    last = sat->chosen;
  }
  return count;
}

}  // namespace

// Which axis made the contact, frame by frame: a switch of rows is a flip-flop.
void axis_history_panel(const PanelFacts& facts, float height) {
  const float scale = facts.staging.layout.scale;
  const trace::Frame& now = facts.frames[facts.current];
  const float top = ImGui::GetCursorPosY();
  heading("chosen axis, frame by frame", scale);
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float width = ImGui::GetContentRegionAvail().x;
  const float left = 62 * scale;
  const float cell = (width - left) / static_cast<float>(facts.frames.size());
  const float available = height - (ImGui::GetCursorPosY() - top);
  const float row =
      std::min(1.8f * line, (available / static_cast<float>(now.pairs.size()) - 1.6f * line) /
                                static_cast<float>(kRows.size()));
  ImDrawList* list = ImGui::GetWindowDrawList();

  for (std::size_t p = 0; p < now.pairs.size(); ++p) {
    const trace::Pair& pair = now.pairs[p];
    const int count = switches(facts, p);
    const std::string title = (pair.label.empty() ? pair.a + ", " + pair.b : pair.label) + ": " +
                              std::to_string(count) + (count == 1 ? " switch" : " switches");
    ImGui::TextUnformatted(title.c_str());
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    for (std::size_t r = 0; r < kRows.size(); ++r) {
      const float y = corner.y + row * static_cast<float>(r);
      list->AddText({corner.x, y + 0.5f * (row - ImGui::GetTextLineHeight())},
                    packed(draw::kQuietText), kRows[r].name);
      list->AddRectFilled({corner.x + left, y + scale}, {corner.x + width, y + row - scale},
                          packed(draw::with_alpha(draw::kQuietText, 0.10f)));
      for (std::size_t f = 0; f <= facts.current; ++f) {
        const auto& sat = facts.frames[f].pairs[p].sat;
        if (!sat || sat->chosen != kRows[r].axis) continue;
        const float x = corner.x + left + cell * static_cast<float>(f);
        const bool is_now = f == facts.current;
        list->AddRectFilled({x, y + scale}, {x + cell + 0.5f, y + row - scale},
                            packed(is_now ? draw::kAxisText : draw::kAxis));
      }
    }
    ImGui::Dummy({width, row * static_cast<float>(kRows.size()) + 0.5f * line});
  }
}

}  // namespace contactscope::overlay

#include "overlay/imgui_style.h"

#include <imgui.h>

#include "draw/scene/palette.h"

namespace contactscope::overlay {

void apply_style(ImGuiStyle& style, float scale) {
  ImGui::StyleColorsLight(&style);
  style.Colors[ImGuiCol_WindowBg] = {draw::kWhite.r, draw::kWhite.g, draw::kWhite.b, 1};
  style.WindowPadding = {12, 10};
  style.WindowRounding = 0;
  style.ScaleAllSizes(scale);  // floors, so that contents begin on whole pixels
  style.WindowBorderSize = 0;
  style.WindowMinSize = {1, 1};
}

}  // namespace contactscope::overlay

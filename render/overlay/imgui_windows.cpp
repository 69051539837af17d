#include "overlay/imgui_windows.h"

#include <imgui.h>

#include <utility>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/palette.h"

namespace contactscope::overlay {
namespace {

void apply_style(ImGuiStyle& style, float scale) {
  ImGui::StyleColorsLight(&style);
  style.Colors[ImGuiCol_WindowBg] = {draw::kWhite.r, draw::kWhite.g, draw::kWhite.b, 1};
  style.WindowPadding = {12, 10};
  style.WindowRounding = 0;
  style.ScaleAllSizes(scale);  // floors, so that contents begin on whole pixels
  style.WindowBorderSize = 0;
  style.WindowMinSize = {1, 1};
  style.AntiAliasedFill = false;  // soft borders would be triangles of two colours
}

draw::Color color_of(ImU32 packed) {
  const ImVec4 color = ImGui::ColorConvertU32ToFloat4(packed);
  return {color.x, color.y, color.z, color.w};
}

void add_triangles(const ImDrawList& list, draw::Drawing& drawing) {
  for (const ImDrawCmd& command : list.CmdBuffer) {
    const ImVec4& clip = command.ClipRect;  // left, top, right, bottom
    const draw::Rect seen{clip.x, clip.y, clip.z - clip.x, clip.w - clip.y};
    for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
      std::vector<draw::Point2> corners;
      ImU32 packed = 0;
      for (unsigned k = 0; k < 3; ++k) {
        const int index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)];
        const ImDrawVert& vertex = list.VtxBuffer[static_cast<int>(command.VtxOffset) + index];
        corners.push_back({vertex.pos.x, vertex.pos.y});
        packed = vertex.col;
      }
      corners = draw::clip_polygon(seen, std::move(corners));
      if (corners.size() > 2)
        drawing.primitives.push_back(draw::Fill{std::move(corners), color_of(packed)});
    }
  }
}

}  // namespace

Windows::Windows(int width, int height, float scale) {
  IMGUI_CHECKVERSION();
  imgui_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(imgui_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // neither read nor left behind
  io.LogFilename = nullptr;
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DeltaTime = 1.0f / 60;
  io.BackendRendererName = "contactscope";
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  io.Fonts->Build();  // Dear ImGui opens no frame without a font
  apply_style(ImGui::GetStyle(), scale);
}

Windows::~Windows() {
  ImGui::DestroyContext(imgui_);
}

void Windows::begin_frame() {
  ImGui::SetCurrentContext(imgui_);
  ImGui::NewFrame();
}

void Windows::end_frame(draw::Drawing& drawing) {
  ImGui::SetCurrentContext(imgui_);
  ImGui::Render();
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i) add_triangles(*data.CmdLists[i], drawing);
}

}  // namespace contactscope::overlay

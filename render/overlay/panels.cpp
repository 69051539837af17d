#include "overlay/panels.h"

#include <imgui.h>

#include "draw/scene/pairs.h"

namespace contactscope::overlay {
namespace {

constexpr double kBetweenPanels = 12;  // pixels at 720 lines

void apply_style(ImGuiStyle& style, float scale) {
  ImGui::StyleColorsLight(&style);
  style.Colors[ImGuiCol_WindowBg] = {draw::kWhite.r, draw::kWhite.g, draw::kWhite.b, 1};
  style.WindowPadding = {draw::kPanelPadding, 10};
  style.WindowRounding = 0;
  style.ScaleAllSizes(scale);  // rounds down, so that contents start on whole pixels
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

struct Window {
  draw::Rect outer, inner;  // with and without padding
};

/// `ground`: paint a background.
Window open_window(const std::string& name, const ImVec2& corner, const ImVec2& size, bool ground) {
  ImGui::SetNextWindowPos(corner);
  ImGui::SetNextWindowSize(size);
  ImGui::Begin(name.c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove |
                   (ground ? 0 : ImGuiWindowFlags_NoBackground));
  const auto rect = [](const ImVec2& at, const ImVec2& extent) {
    return draw::Rect{at.x, at.y, extent.x, extent.y};
  };
  const Window window{rect(ImGui::GetWindowPos(), ImGui::GetWindowSize()),
                      rect(ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail())};
  ImGui::End();
  return window;
}

/// A line of one pixel along the inside of a window's edge.
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

Windows::Windows(int width, int height, float scale) {
  IMGUI_CHECKVERSION();
  imgui_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(imgui_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // no file access
  io.LogFilename = nullptr;
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DeltaTime = 1.0f / 60;
  io.BackendRendererName = "contactscope";
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  io.Fonts->Build();  // Dear ImGui requires a font
  apply_style(ImGui::GetStyle(), scale);
}

Windows::~Windows() { ImGui::DestroyContext(imgui_); }

void Windows::begin_frame() {
  ImGui::SetCurrentContext(imgui_);
  ImGui::NewFrame();
}

void Windows::end_frame(draw::Drawing& drawing) {
  ImGui::SetCurrentContext(imgui_);
  ImGui::Render();
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    drawing.begin(draw::kPanelPart, {}, data.CmdLists[i]->_OwnerName);
    add_triangles(*data.CmdLists[i], drawing);
  }
}

PanelColumn::PanelColumn(const draw::Staging& staging, const std::vector<trace::Frame>& frames)
    : layout_(staging.layout),
      panels_(draw::make_panels(staging, frames)),
      windows_(layout_.width, layout_.height, layout_.scale) {}

void PanelColumn::renew(const draw::Staging& staging, const std::vector<trace::Frame>& frames) {
  panels_ = draw::make_panels(staging, frames);
}

std::vector<std::string> PanelColumn::add(const draw::PanelMoment& moment, draw::Drawing& drawing) {
  draw::Drawing contents;
  contents.words = layout_.words;
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
      without_room += (without_room.empty() ? "no room for " : ", ") + draw::in_words(name);
      continue;
    }
    const Window window = open_window(name, {left, y}, {width, heights[i]}, layout_.ground);
    contents.begin(draw::kPanelPart, {}, name);
    draw::Sheet sheet(window.inner, layout_.scale, contents);
    draw_border(window.outer, sheet.pen());
    const std::string missing = panels_[i].content->lay_out(moment, sheet);
    if (!missing.empty()) left_out.push_back(missing + " of panel " + name);
    y += heights[i] + gap;
  }
  if (!without_room.empty()) {
    contents.begin(draw::kPanelPart);
    draw::Sheet(draw::Rect{column.x, y - gap + layout_.px(4), column.width, column.height},
                layout_.scale, contents)
        .line(without_room, draw::kQuietText);
  }
  windows_.end_frame(drawing);
  drawing.append(contents);
  return left_out;
}

}  // namespace contactscope::overlay

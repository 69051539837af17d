#pragma once

#include <imgui.h>

#include <string>

#include "draw/scene/drawing.h"

namespace contactscope::overlay {

/// A colour of the palette as Dear ImGui packs it.
inline ImU32 packed(const draw::Color& color) {
  return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, color.a});
}

/// A heading in the panel's bold font and a thin rule under it.
void heading(const char* text, float scale);

/// Height of a heading, and of what is around a panel's contents: padding, top and bottom.
float heading_height(float scale);
float panel_frame();

/// "and 2 more pairs", in the quiet colour; of none nothing. Returns "2 pairs".
std::string more(std::size_t count, const char* one, const char* many);

/// Text centred at a point.
void centered_text(ImDrawList* list, ImVec2 at, const draw::Color& color, const char* text);

/// Paints a drawing of the picture's pixels through Dear ImGui: what stands in a panel can be made,
/// and tested, without it.
void paint(const draw::Drawing& drawing, ImDrawList* list);

}  // namespace contactscope::overlay

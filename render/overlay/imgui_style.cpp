#include "overlay/imgui_style.h"

#include <imgui.h>

#include <cmath>

#include "draw/scene/palette.h"
#include "image/font.h"

namespace contactscope::overlay {
namespace {

constexpr float kTextSize = 15, kHeadingSize = 16;  // pixels at 720 lines

// Pairs of first and last code point; the zero ends them. Kept as long as the program runs, as
// Dear ImGui asks.
constexpr ImWchar kRanges[] = {0x0020, 0x017F,  // Latin, Latin-1, Latin Extended-A
                               0x0391, 0x03C9,  // Greek
                               0x2010, 0x2026,  // dashes, quotation marks, bullet, ellipsis
                               0x2070, 0x208E,  // superscripts, subscripts
                               0x2212, 0x2212,  // minus
                               0x221E, 0x221E,  // infinity
                               0x2248, 0x2248,  // almost equal
                               0x2264, 0x2265,  // at most, at least
                               0xFFFD, 0xFFFD,  // replacement
                               0};

void add_font(ImFontAtlas& fonts, FontWeight weight, float size) {
  const std::span<const unsigned char> data = font_data(weight);
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.GlyphRanges = kRanges;
  // Dear ImGui takes a pointer to bytes that it may own, and copies those that it does not.
  fonts.AddFontFromMemoryTTF(const_cast<unsigned char*>(data.data()), static_cast<int>(data.size()),
                             std::round(size), &config);
}

ImVec4 color(const draw::Color& c) {
  return {c.r, c.g, c.b, c.a};
}

}  // namespace

void add_fonts(ImFontAtlas& fonts, float scale) {
  add_font(fonts, FontWeight::Regular, kTextSize * scale);
  add_font(fonts, FontWeight::Bold, kHeadingSize * scale);
}

void apply_style(ImGuiStyle& style, float scale) {
  ImGui::StyleColorsLight(&style);
  style.Colors[ImGuiCol_WindowBg] = color(draw::kWhite);
  style.Colors[ImGuiCol_Text] = color(draw::kText);
  style.Colors[ImGuiCol_Border] = color(draw::with_alpha(draw::kQuietText, 0.35f));
  style.Colors[ImGuiCol_Separator] = color(draw::with_alpha(draw::kQuietText, 0.5f));
  style.WindowPadding = {12, 10};
  style.ItemSpacing = {8, 4};
  style.WindowRounding = 0;
  style.ScaleAllSizes(scale);  // floors, so that text keeps to whole pixels
  style.WindowBorderSize = 1;
  style.WindowMinSize = {1, 1};
}

}  // namespace contactscope::overlay

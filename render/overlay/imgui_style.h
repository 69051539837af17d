#pragma once

struct ImFontAtlas;
struct ImGuiStyle;

namespace contactscope::overlay {

/// Adds the embedded fonts at the panels' sizes: regular first, bold last.
void add_fonts(ImFontAtlas& fonts, float scale);

/// White panels with a quiet frame and square corners, in the colours of the pictures.
void apply_style(ImGuiStyle& style, float scale);

}  // namespace contactscope::overlay

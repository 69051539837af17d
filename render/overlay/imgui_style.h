#pragma once

struct ImGuiStyle;

namespace contactscope::overlay {

/// White windows with square corners. Their borders belong to what stands in them.
void apply_style(ImGuiStyle& style, float scale);

}  // namespace contactscope::overlay

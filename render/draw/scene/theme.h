#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "draw/scene/drawing.h"

/// Themes: what becomes of the colours of a finished drawing, and of nothing else in it.
namespace contactscope::draw {

enum class Theme {
  Light,  // the colours as they are, on white
  Dark,   // for dark slides
  Grey,   // for a printer without colours: roles keep apart by lightness
  Print,  // black text, no tint so light that a press loses it
};
inline constexpr std::array<std::string_view, 4> kThemeNames = {"light", "dark", "grey", "print"};

/// What a colour is used for: text needs more contrast with the ground than lines.
enum class ColorUse { Fill, Line, Text, Halo };

/// What a theme's drawings stand on.
Color ground_of(Theme theme);

/// A colour in a theme. White becomes `ground`, whatever it is used for: it is what a drawing leaves
/// free. Alpha is kept but where the theme prints, which strengthens what is faint.
Color themed(const Color& color, ColorUse use, Theme theme, const Color& ground);

/// All colours of a drawing. `background`: what it stands on instead of the theme's ground; with
/// alpha 0 nothing is painted there, and what is left free takes the theme's ground.
void apply_theme(Theme theme, const std::optional<Color>& background, Drawing& drawing);

/// Contrast of two opaque colours, 1 to 21 (WCAG 2.2, "contrast ratio").
double contrast(const Color& a, const Color& b);

}  // namespace contactscope::draw

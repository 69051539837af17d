#pragma once

#include "draw/scene/drawing.h"

/// Themes change the colours of a finished drawing and nothing else.
namespace contactscope::draw {

enum class Theme {
  Light,  // unchanged colours on white
  Dark,   // for dark slides
  Grey,   // for printers without colours: roles differ by lightness
  Print,  // black text, and no tint so light that a press loses it
};
inline constexpr std::array<std::string_view, 4> kThemeNames = {"light", "dark", "grey", "print"};

/// Use of a colour. Text needs more contrast with the ground than lines.
enum class ColorUse { Fill, Line, Text, Halo };

/// Background colour of a theme.
Color ground_of(Theme theme);

/// Converts a colour to a theme. White always becomes `ground`, because it represents an empty
/// background. Alpha changes only in the print theme, which strengthens faint colours.
Color themed(const Color& color, ColorUse use, Theme theme, const Color& ground);

/// Converts all colours of a drawing. `background` replaces the theme's ground. With alpha 0 the
/// background is transparent, and white becomes the theme's ground.
void apply_theme(Theme theme, const std::optional<Color>& background, Drawing& drawing);

/// Contrast of two opaque colours, 1 to 21 (WCAG 2.2, "contrast ratio").
double contrast(const Color& a, const Color& b);

}  // namespace contactscope::draw

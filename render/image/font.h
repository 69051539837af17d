#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace contactscope {

enum class FontWeight { Regular, Bold };

/// The TrueType file that the build embedded (Roboto). The same bytes serve labels and panels.
std::span<const unsigned char> font_data(FontWeight weight);

/// A file that is no font with TrueType outlines. what() carries its path and the remedy.
class FontError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Lets a TrueType file (.ttf, or .otf and .ttc with glyf outlines) draw the characters that the
/// fonts before it lack; `bold` may be empty, then one file serves both weights. The embedded font
/// always comes first, so that a picture that does without looks the same. Before the first text is
/// measured, and not while another thread measures some. Throws FontError and
/// std::filesystem::filesystem_error.
void add_font(const std::string& regular, const std::string& bold = {});

/// The font that draws a code point: 0, the embedded one, or the number of an added one, from 1. 0
/// also where none has it; a question mark stands there then.
std::size_t font_for(char32_t code_point, FontWeight weight);
/// The file of a font by that number.
std::span<const unsigned char> font_data(FontWeight weight, std::size_t number);
/// Pixels from the ascender to the descender of the embedded font for one pixel of its em; all fonts
/// are drawn with an em of the same size.
float line_of_em(FontWeight weight);

/// Coverage of one glyph, and where it goes: the bitmap's top left corner lies at (left, top) from
/// the pen on the baseline, pixels, y down.
struct GlyphBitmap {
  int width = 0, height = 0;
  int left = 0, top = 0;
  std::vector<std::uint8_t> coverage{};  // width * height
};

/// Text metrics and glyph coverage. Heights are the embedded font's. `size` is pixels from ascender to
/// descender. Bytes that are no UTF-8 count as U+FFFD. Kerning is left out: digits stay tabular.
float text_width(std::string_view utf8, float size, FontWeight weight);
/// Height in pixels of the font's ascender, and depth of its descender (positive), at `size`.
float ascent(float size, FontWeight weight);
float descent(float size, FontWeight weight);
/// Pixels of the font's em at `size`: what other programs call the size of a font.
float em_size(float size, FontWeight weight);
/// Advance of one code point in pixels.
float advance(char32_t code_point, float size, FontWeight weight);
/// Whether any font has a glyph for a code point; where none has, a question mark is drawn.
bool has_glyph(char32_t code_point, FontWeight weight);
/// Coverage of a glyph whose pen stands at `subpixel_x` in [0, 1) right of a pixel's left edge,
/// grown by a soft border of `halo` pixels (0 for the letter itself).
GlyphBitmap rasterize_glyph(char32_t code_point, float size, FontWeight weight, float subpixel_x,
                            float halo);
/// Code points of UTF-8 text.
std::vector<char32_t> code_points(std::string_view utf8);

}  // namespace contactscope

#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace contactscope {

enum class FontWeight { Regular, Bold };

/// The embedded TrueType file (Roboto), used for labels and panels.
std::span<const unsigned char> font_data(FontWeight weight);

/// Not a font with TrueType outlines. what() has the path and a remedy.
class FontError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Adds a TrueType file (.ttf, or .otf and .ttc with glyf outlines) for characters that the
/// previous fonts lack. If `bold` is empty, `regular` serves both weights. The embedded font always
/// has precedence, so pictures without such characters do not change. Call it before any text is
/// measured, not concurrently. Throws FontError and std::filesystem::filesystem_error.
void add_font(const std::string& regular, const std::string& bold = {});

/// Number of the font with a code point: 0 for the embedded one, from 1 for added ones. Also 0 if
/// no font has it; a question mark is drawn then.
std::size_t font_for(char32_t code_point, FontWeight weight);
std::span<const unsigned char> font_data(FontWeight weight, std::size_t number);
/// Ascender-to-descender height of the embedded font relative to its em. All fonts are drawn with
/// the same em size.
float line_of_em(FontWeight weight);

/// Coverage and position of a glyph: the bitmap's top left corner is at (left, top) relative to the
/// pen on the baseline, in pixels, y down.
struct GlyphBitmap {
  int width = 0, height = 0;
  int left = 0, top = 0;
  std::vector<std::uint8_t> coverage{};  // width * height
};

/// Text metrics and glyph coverage. `size` and heights are pixels, from ascender to descender of
/// the embedded font. Invalid UTF-8 counts as U+FFFD. No kerning: digits stay tabular.
float text_width(std::string_view utf8, float size, FontWeight weight);
/// Pixels from the baseline up to the ascender and down to the descender, both positive.
float ascent(float size, FontWeight weight);
float descent(float size, FontWeight weight);
/// Em size in pixels at `size`: the font size in other programs.
float em_size(float size, FontWeight weight);
/// Advance width of a code point in pixels.
float advance(char32_t code_point, float size, FontWeight weight);
/// True if any font has a glyph; otherwise a question mark is drawn.
bool has_glyph(char32_t code_point, FontWeight weight);
/// Coverage of a glyph with the pen at `subpixel_x` in [0, 1) from a pixel's left edge, dilated by
/// a soft border of `halo` pixels (0: none).
GlyphBitmap rasterize_glyph(char32_t code_point, float size, FontWeight weight, float subpixel_x,
                            float halo);
std::vector<char32_t> code_points(std::string_view utf8);
std::string utf8_of(char32_t code_point);

/// Corner of a closed polygon, pixels, y down.
struct ContourPoint {
  double x = 0, y = 0;
};
using Contour = std::vector<ContourPoint>;

/// Exact area of each pixel inside an outline, in 255 steps, rows from the top. Contours of one
/// winding are solid, those of the other are holes. Outlines must stay within the bitmap.
///
/// Glyphs are not rasterized by the library that reads the font, so that labels have the same
/// pixels with every version of it. Sums of areas in double, without fused multiply-adds, are also
/// the same on every processor.
std::vector<std::uint8_t> coverage_of(const std::vector<Contour>& outline, int width, int height);

}  // namespace contactscope

#include "image/font.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <optional>

#include "image/encoding.h"

// Only reads the font. Static, so that no shared library of another version can replace it.
#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>

namespace contactscope {
namespace {

/// A font file, parsed by stb_truetype.
struct Face {
  std::span<const unsigned char> data;
  stbtt_fontinfo info{};
};

/// A font in both weights.
struct Font {
  std::vector<unsigned char> regular, bold;  // data of an added font
  Face faces[2];

  const Face& face(FontWeight weight) const { return faces[weight == FontWeight::Bold ? 1 : 0]; }
};

/// Nullopt if the bytes are not a font.
std::optional<Face> load(std::span<const unsigned char> data) {
  Face face{data};
  if (data.size() < 12) return std::nullopt;
  const int offset = stbtt_GetFontOffsetForIndex(data.data(), 0);
  if (offset < 0 || !stbtt_InitFont(&face.info, data.data(), offset)) return std::nullopt;
  return face;
}

Font embedded_font() {
  const std::optional<Face> regular = load(font_data(FontWeight::Regular));
  const std::optional<Face> bold = load(font_data(FontWeight::Bold));
  if (!regular || !bold) std::abort();  // the build embedded an invalid font
  return {{}, {}, {*regular, *bold}};
}

/// The embedded font comes first.
std::deque<Font>& fonts() {
  static std::deque<Font> all{embedded_font()};
  return all;
}

const stbtt_fontinfo& font(FontWeight weight) { return fonts().front().face(weight).info; }

float scale_of(float size, FontWeight weight) {
  return stbtt_ScaleForPixelHeight(&font(weight), size);
}

/// The font and index of a glyph, and the scale from font units to pixels.
struct GlyphSource {
  const stbtt_fontinfo* info;
  int glyph;
  float scale;
};

GlyphSource source_of(char32_t code_point, float size, FontWeight weight) {
  const float own = scale_of(size, weight);
  const stbtt_fontinfo& first = font(weight);
  const int glyph = stbtt_FindGlyphIndex(&first, static_cast<int>(code_point));
  if (glyph != 0) return {&first, glyph, own};
  const std::size_t number = font_for(code_point, weight);
  if (number == 0) return {&first, stbtt_FindGlyphIndex(&first, '?'), own};
  const stbtt_fontinfo& info = fonts()[number].face(weight).info;
  const float em = own / stbtt_ScaleForMappingEmToPixels(&first, 1);  // pixels
  return {&info, stbtt_FindGlyphIndex(&info, static_cast<int>(code_point)),
          stbtt_ScaleForMappingEmToPixels(&info, em)};
}

/// largest distance of a chord from its curve, pixels
constexpr float kFlatness = 0.35f;

/// Bisects a quadratic curve until chords are within `flatness`, and adds their end points.
void add_curve(const ContourPoint& from, const ContourPoint& control, const ContourPoint& to,
               double flatness, Contour& contour) {
  const ContourPoint middle{0.25 * (from.x + 2 * control.x + to.x),
                            0.25 * (from.y + 2 * control.y + to.y)};
  const double dx = 0.5 * (from.x + to.x) - middle.x, dy = 0.5 * (from.y + to.y) - middle.y;
  if (dx * dx + dy * dy <= flatness * flatness) {
    contour.push_back(to);
    return;
  }
  add_curve(from, {0.5 * (from.x + control.x), 0.5 * (from.y + control.y)}, middle, flatness,
            contour);
  add_curve(middle, {0.5 * (control.x + to.x), 0.5 * (control.y + to.y)}, to, flatness, contour);
}

/// Outline of a glyph with the pen at (left, top) of the bitmap, in pixels. TrueType outlines
/// consist of lines and quadratic curves.
std::vector<Contour> outline_of(const stbtt_fontinfo& info, int glyph, float scale, float left,
                                float top) {
  stbtt_vertex* vertices = nullptr;
  const int count = stbtt_GetGlyphShape(&info, glyph, &vertices);
  std::vector<Contour> outline;  // in units of the font, y up
  const auto corner = [](double x, double y) { return ContourPoint{x, y}; };
  for (int i = 0; i < count; ++i) {
    const stbtt_vertex& vertex = vertices[i];
    const ContourPoint to = corner(vertex.x, vertex.y);
    if (vertex.type == STBTT_vmove) {
      outline.push_back({to});
    } else if (vertex.type == STBTT_vcurve) {
      const ContourPoint from = outline.back().back();
      add_curve(from, corner(vertex.cx, vertex.cy), to, kFlatness / scale, outline.back());
    } else {
      outline.back().push_back(to);
    }
  }
  stbtt_FreeShape(&info, vertices);
  for (Contour& contour : outline) {
    for (ContourPoint& point : contour) {
      point = {static_cast<double>(scale) * point.x + static_cast<double>(left),
               static_cast<double>(top) - static_cast<double>(scale) * point.y};
    }
  }
  return outline;
}

/// Dilates a coverage bitmap by a disc: each pixel takes the largest coverage within reach, faded
/// over the last pixel of the disc. Exact along straight edges: a pixel k steps outside of a
/// covered one gets halo - (k - 1), clamped.
GlyphBitmap dilated(const GlyphBitmap& glyph, float halo) {
  const int reach = static_cast<int>(std::ceil(halo));
  GlyphBitmap out{glyph.width + 2 * reach, glyph.height + 2 * reach, glyph.left - reach,
                  glyph.top - reach};
  const auto width = static_cast<std::size_t>(out.width);
  out.coverage.resize(width * static_cast<std::size_t>(out.height));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const float distance = std::sqrt(static_cast<float>(dx * dx + dy * dy));
      const float weight = std::clamp(halo + 1.0f - distance, 0.0f, 1.0f);
      if (weight == 0) continue;
      for (int y = 0; y < glyph.height; ++y) {
        const std::uint8_t* from =
            &glyph.coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(glyph.width)];
        std::uint8_t* to = &out.coverage[static_cast<std::size_t>(y + dy + reach) * width +
                                         static_cast<std::size_t>(dx + reach)];
        for (int x = 0; x < glyph.width; ++x) {
          const float faded = static_cast<float>(from[x]) * weight;
          to[x] = std::max(to[x], static_cast<std::uint8_t>(faded + 0.5f));
        }
      }
    }
  }
  return out;
}

constexpr char32_t kReplacement = 0xFFFD;

/// Length in bytes of a sequence that starts with `lead`; 0 if invalid.
std::size_t sequence_length(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;  // 0xC0 and 0xC1 would only start overlong forms
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  if (lead >= 0xF0 && lead < 0xF5) return 4;
  return 0;
}

bool is_scalar_value(char32_t code, std::size_t length) {
  const char32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code >= smallest[length] && code <= 0x10FFFF && !surrogate;
}

/// Accumulates the edges of an outline. Each edge covers the pixels on its right, positive if it
/// goes down and negative if it goes up; the prefix sum of a row is its coverage. Two extra columns
/// take the contributions of edges at the right border.
struct CoverageSums {
  int width, height;
  std::vector<double> sums = std::vector<double>(index(height, 0));

  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width + 2) +
           static_cast<std::size_t>(column);
  }

  void add_edge(ContourPoint from, ContourPoint to) {
    if (from.y == to.y) return;
    const double direction = from.y < to.y ? 1 : -1;
    if (direction < 0) std::swap(from, to);
    const double slope = (to.x - from.x) / (to.y - from.y);
    const auto x_at = [&](double y) {
      return std::clamp(from.x + slope * (y - from.y), 0.0, static_cast<double>(width));
    };
    const int first = std::max(0, static_cast<int>(std::floor(from.y)));
    const int last = std::min(height, static_cast<int>(std::ceil(to.y)));
    for (int row = first; row < last; ++row) {
      const double top = std::max<double>(from.y, row), bottom = std::min<double>(to.y, row + 1);
      add_to_row(row, x_at(top), x_at(bottom), direction * (bottom - top));
    }
  }

  /// Adds a part of an edge within one row, with its signed height `rise`.
  void add_to_row(int row, double x0, double x1, double rise) {
    const auto [left, right] = std::minmax(x0, x1);
    const int first = static_cast<int>(std::floor(left));
    for (int column = first; column == first || column < right; ++column) {
      // Split at columns: this part covers its pixel from the mean of its ends to the right, and
      // all pixels to the right fully.
      const double from = std::max<double>(left, column), to = std::min<double>(right, column + 1);
      const double part = right > left ? rise * (to - from) / (right - left) : rise;
      const double uncovered = part * (0.5 * (from + to) - column);
      sums[index(row, column)] += part - uncovered;
      sums[index(row, column + 1)] += uncovered;
    }
  }
};

}  // namespace

float ascent(float size, FontWeight weight) {
  int up = 0;
  stbtt_GetFontVMetrics(&font(weight), &up, nullptr, nullptr);
  return static_cast<float>(up) * scale_of(size, weight);
}

float descent(float size, FontWeight weight) {
  int down = 0;
  stbtt_GetFontVMetrics(&font(weight), nullptr, &down, nullptr);
  return static_cast<float>(-down) * scale_of(size, weight);
}

void add_font(const std::string& regular, const std::string& bold) {
  Font& added = fonts().emplace_back();
  const auto read = [](const std::string& path, std::vector<unsigned char>& bytes) {
    try {
      bytes = read_whole_file(path);
    } catch (const std::filesystem::filesystem_error& error) {
      throw FontError(path + ": " + error.code().message() +
                      "; give a .ttf file, e.g. of fonts-noto-core");
    } catch (const std::runtime_error& error) {
      throw FontError(std::string(error.what()) + "; give a .ttf file, e.g. of fonts-noto-core");
    }
    const std::optional<Face> face = load(bytes);
    if (!face)
      throw FontError(path +
                      ": this is not a TrueType font; give a .ttf file, e.g. of fonts-noto-core");
    if (face->info.glyf == 0)
      throw FontError(path + ": this font has no TrueType outlines (glyf); give its .ttf file");
    return *face;
  };
  try {
    added.faces[0] = added.faces[1] = read(regular, added.regular);
    if (!bold.empty()) added.faces[1] = read(bold, added.bold);
  } catch (...) {
    fonts().pop_back();
    throw;
  }
}

std::size_t font_for(char32_t code_point, FontWeight weight) {
  const std::deque<Font>& all = fonts();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (stbtt_FindGlyphIndex(&all[i].face(weight).info, static_cast<int>(code_point)) != 0)
      return i;
  }
  return 0;
}

std::span<const unsigned char> font_data(FontWeight weight, std::size_t number) {
  return fonts()[number].face(weight).data;
}

float line_of_em(FontWeight weight) {
  return stbtt_ScaleForMappingEmToPixels(&font(weight), 1) / scale_of(1, weight);
}

bool has_glyph(char32_t code_point, FontWeight weight) {
  return font_for(code_point, weight) > 0 ||
         stbtt_FindGlyphIndex(&font(weight), static_cast<int>(code_point)) != 0;
}

float em_size(float size, FontWeight weight) {
  return scale_of(size, weight) / stbtt_ScaleForMappingEmToPixels(&font(weight), 1);
}

float advance(char32_t code_point, float size, FontWeight weight) {
  const GlyphSource source = source_of(code_point, size, weight);
  int width = 0, bearing = 0;
  stbtt_GetGlyphHMetrics(source.info, source.glyph, &width, &bearing);
  return static_cast<float>(width) * source.scale;
}

float text_width(std::string_view utf8, float size, FontWeight weight) {
  float width = 0;
  for (const char32_t code : code_points(utf8)) width += advance(code, size, weight);
  return width;
}

GlyphBitmap rasterize_glyph(char32_t code_point, float size, FontWeight weight, float subpixel_x,
                            float halo) {
  assert(size > 0 && subpixel_x >= 0 && subpixel_x < 1 && halo >= 0);
  const GlyphSource source = source_of(code_point, size, weight);
  const stbtt_fontinfo& info = *source.info;
  const float scale = source.scale;
  const int glyph = source.glyph;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  stbtt_GetGlyphBitmapBoxSubpixel(&info, glyph, scale, scale, subpixel_x, 0, &x0, &y0, &x1, &y1);
  if (x1 <= x0 || y1 <= y0) return {};  // a space
  GlyphBitmap out{x1 - x0, y1 - y0, x0, y0};
  out.coverage = coverage_of(
      outline_of(info, glyph, scale, subpixel_x - static_cast<float>(x0), static_cast<float>(-y0)),
      out.width, out.height);
  return halo > 0 ? dilated(out, halo) : out;
}

std::vector<char32_t> code_points(std::string_view utf8) {
  std::vector<char32_t> out;
  out.reserve(utf8.size());
  for (std::size_t i = 0; i < utf8.size();) {
    const unsigned char lead = static_cast<unsigned char>(utf8[i]);
    const std::size_t length = sequence_length(lead);
    bool valid = length != 0 && i + length <= utf8.size();
    char32_t code = length <= 1 ? lead : lead & (0xFFu >> (length + 1));
    for (std::size_t k = 1; valid && k < length; ++k) {
      const unsigned char next = static_cast<unsigned char>(utf8[i + k]);
      valid = (next & 0xC0) == 0x80;
      code = code << 6 | (next & 0x3Fu);
    }
    valid = valid && is_scalar_value(code, length);
    out.push_back(valid ? code : kReplacement);
    i += valid ? length : 1;
  }
  return out;
}

std::string utf8_of(char32_t code) {
  const auto byte = [](char32_t bits) { return static_cast<char>(bits); };
  const auto tail = [&](int shift) { return byte(0x80 | ((code >> shift) & 0x3F)); };
  if (code < 0x80) return {byte(code)};
  if (code < 0x800) return {byte(0xC0 | code >> 6), tail(0)};
  if (code < 0x10000) return {byte(0xE0 | code >> 12), tail(6), tail(0)};
  return {byte(0xF0 | code >> 18), tail(12), tail(6), tail(0)};
}

std::vector<std::uint8_t> coverage_of(const std::vector<Contour>& outline, int width, int height) {
  CoverageSums all{width, height};
  for (const Contour& contour : outline) {
    for (std::size_t i = 0; i < contour.size(); ++i)
      all.add_edge(contour[i], contour[(i + 1) % contour.size()]);
  }
  std::vector<std::uint8_t> coverage;
  coverage.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = 0; row < height; ++row) {
    double sum = 0;
    for (int column = 0; column < width; ++column) {
      sum += all.sums[all.index(row, column)];
      coverage.push_back(static_cast<std::uint8_t>(std::min(1.0, std::abs(sum)) * 255 + 0.5));
    }
  }
  return coverage;
}

}  // namespace contactscope

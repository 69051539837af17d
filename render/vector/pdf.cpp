#include "vector/svg.h"

#include <cairo-ft.h>
#include <cairo-pdf.h>

#include <ctime>

#include "vector/pieces.h"

namespace contactscope::vector {
namespace {

// Width in pixels of a line around opaque surface polygons. It closes the seams that viewers show
// between neighbours with soft edges.
constexpr double kSeam = 0.3;

// Functions of cairo and its dependency FreeType used here.
#define CONTACTSCOPE_CAIRO(ROW)              \
  ROW(cairo_arc)                             \
  ROW(cairo_close_path)                      \
  ROW(cairo_create)                          \
  ROW(cairo_destroy)                         \
  ROW(cairo_fill)                            \
  ROW(cairo_font_options_create)             \
  ROW(cairo_font_options_destroy)            \
  ROW(cairo_font_options_set_hint_metrics)   \
  ROW(cairo_font_options_set_hint_style)     \
  ROW(cairo_ft_font_face_create_for_ft_face) \
  ROW(cairo_glyph_path)                      \
  ROW(cairo_line_to)                         \
  ROW(cairo_move_to)                         \
  ROW(cairo_new_path)                        \
  ROW(cairo_paint)                           \
  ROW(cairo_pdf_surface_create_for_stream)   \
  ROW(cairo_pdf_surface_restrict_to_version) \
  ROW(cairo_pdf_surface_set_metadata)        \
  ROW(cairo_scale)                           \
  ROW(cairo_set_dash)                        \
  ROW(cairo_set_font_face)                   \
  ROW(cairo_set_font_options)                \
  ROW(cairo_set_font_size)                   \
  ROW(cairo_set_line_cap)                    \
  ROW(cairo_set_line_join)                   \
  ROW(cairo_set_line_width)                  \
  ROW(cairo_set_source_rgba)                 \
  ROW(cairo_show_text_glyphs)                \
  ROW(cairo_status)                          \
  ROW(cairo_status_to_string)                \
  ROW(cairo_stroke)                          \
  ROW(cairo_surface_destroy)                 \
  ROW(cairo_surface_finish)                  \
  ROW(cairo_surface_status)                  \
  ROW(FT_Get_Char_Index)                     \
  ROW(FT_Init_FreeType)                      \
  ROW(FT_New_Memory_Face)

struct CairoFunctions {
  SharedLibrary library{"libcairo.so.2", "libcairo2", "PDF"};
  CONTACTSCOPE_FUNCTIONS(CairoFunctions, CONTACTSCOPE_CAIRO)
};
#undef CONTACTSCOPE_CAIRO

const CairoFunctions& cairo() {
  static const CairoFunctions functions;
  return functions;
}

cairo_status_t write_to(void* closure, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

/// "2026-11-23T18:00:00Z".
std::string date_of_creation() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t seconds = epoch == nullptr ? 0 : std::strtoll(epoch, nullptr, 10);
  std::tm broken_down{};
  gmtime_r(&seconds, &broken_down);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &broken_down);
  return text.data();
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(std::string("PDF: ") + cairo().cairo_status_to_string(status));
}

template <class Object> using Owned = std::unique_ptr<Object, void (*)(Object*)>;

/// A font for FreeType and cairo. Cairo caches it beyond the lifetime of a picture.
struct Typeface {
  FT_Face face = nullptr;
  cairo_font_face_t* for_cairo = nullptr;
};

/// All fonts of the program, opened on first use.
class Fonts {
 public:
  Fonts() {
    if (cairo().FT_Init_FreeType(&library_) != 0)
      throw std::runtime_error("PDF: FreeType cannot start");
  }

  const Typeface& find(const FontKey& key) {
    Typeface& typeface = typefaces_[key];
    if (typeface.for_cairo != nullptr) return typeface;
    const std::span<const unsigned char> data = font_data(key.weight, key.number);
    if (cairo().FT_New_Memory_Face(library_, data.data(), static_cast<FT_Long>(data.size()), 0,
                                   &typeface.face) != 0)
      throw std::runtime_error("PDF: FreeType cannot read the font");
    typeface.for_cairo = cairo().cairo_ft_font_face_create_for_ft_face(typeface.face, 0);
    return typeface;
  }

 private:
  FT_Library library_ = nullptr;
  std::map<FontKey, Typeface> typefaces_;
};

/// Consecutive glyphs of one font, with the text bytes of each, so that viewers can copy the text.
struct GlyphRun {
  FontKey font;
  std::vector<cairo_glyph_t> glyphs{};
  std::vector<cairo_text_cluster_t> clusters{};
  std::string utf8{};
};

struct PdfWriter {
  const CairoFunctions& c;
  cairo_t* page;
  Fonts& fonts;

  void set_color(const Color& color) const {
    c.cairo_set_source_rgba(page, color.r, color.g, color.b, color.a);
  }

  void trace(const std::vector<Point2>& points, bool closed) const {
    c.cairo_move_to(page, points.front().x, points.front().y);
    for (std::size_t i = 1; i < points.size(); ++i) c.cairo_line_to(page, points[i].x, points[i].y);
    if (closed) c.cairo_close_path(page);
  }

  void add(const FillPath& fill, bool surface) const {
    set_color(fill.color);
    const auto trace_all = [&] {
      for (const std::vector<Point2>& polygon : fill.polygons) trace(polygon, true);
    };
    trace_all();
    c.cairo_fill(page);
    if (!surface || fill.color.a < 1) return;
    c.cairo_set_line_width(page, kSeam);
    c.cairo_set_line_cap(page, CAIRO_LINE_CAP_BUTT);
    c.cairo_set_dash(page, nullptr, 0, 0);
    trace_all();
    c.cairo_stroke(page);
  }

  void add(const StrokePath& stroke, bool) const {
    set_color(stroke.color);
    c.cairo_set_line_width(page, stroke.width);
    c.cairo_set_line_cap(page,
                         stroke.cap == Cap::Round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    const std::array<double, 2> dashes = {stroke.dash, stroke.gap};
    c.cairo_set_dash(page, dashes.data(), stroke.gap > 0 ? 2 : 0, stroke.phase);
    for (const Polyline& line : stroke.lines) trace(line.points, line.closed);
    c.cairo_stroke(page);
  }

  void add(const Disc& disc, bool) const {
    set_color(disc.color);
    const bool ring = disc.inner > 0;
    const double radius = ring ? 0.5 * (disc.inner + disc.outer) : disc.outer;
    c.cairo_new_path(page);
    c.cairo_arc(page, disc.center.x, disc.center.y, radius, 0, 2 * std::numbers::pi);
    c.cairo_close_path(page);
    if (!ring) {
      c.cairo_fill(page);
      return;
    }
    c.cairo_set_line_width(page, disc.outer - disc.inner);
    c.cairo_set_dash(page, nullptr, 0, 0);
    c.cairo_stroke(page);
  }

  void add(const PlacedText& placed, bool) const {
    const Text& text = *placed.text;
    const std::vector<GlyphRun> runs = runs_of(placed);
    c.cairo_set_font_size(page, em_size(text.size, text.weight));
    if (text.halo > 0 && text.halo_color.a > 0) {
      set_color(text.halo_color);
      c.cairo_set_line_width(page, 2 * text.halo);
      c.cairo_set_dash(page, nullptr, 0, 0);
      for (const GlyphRun& run : runs) {
        c.cairo_set_font_face(page, fonts.find(run.font).for_cairo);
        c.cairo_glyph_path(page, run.glyphs.data(), static_cast<int>(run.glyphs.size()));
      }
      c.cairo_stroke(page);
    }
    set_color(text.color);
    for (const GlyphRun& run : runs) {
      const int count = static_cast<int>(run.glyphs.size());
      c.cairo_set_font_face(page, fonts.find(run.font).for_cairo);
      c.cairo_show_text_glyphs(page, run.utf8.data(), static_cast<int>(run.utf8.size()),
                               run.glyphs.data(), count, run.clusters.data(), count,
                               static_cast<cairo_text_cluster_flags_t>(0));
    }
  }

  std::vector<GlyphRun> runs_of(const PlacedText& placed) const {
    const Text& text = *placed.text;
    std::vector<GlyphRun> runs;
    double pen = placed.left.x;
    for (const char32_t code : code_points(text.text)) {
      const FontKey font{text.weight, font_for(code, text.weight)};
      if (runs.empty() || runs.back().font != font) runs.push_back({font});
      GlyphRun& run = runs.back();
      // Characters without a glyph are question marks, as in pixels.
      const char32_t drawn = has_glyph(code, text.weight) ? code : U'?';
      run.glyphs.push_back({c.FT_Get_Char_Index(fonts.find(font).face, drawn), pen, placed.left.y});
      const std::string bytes = utf8_of(code);
      run.utf8 += bytes;
      run.clusters.push_back({static_cast<int>(bytes.size()), 1});
      pen += static_cast<double>(advance(code, text.size, text.weight));
    }
    return runs;
  }
};

void set_metadata(cairo_surface_t* surface, const PictureOrigin* origin) {
  const CairoFunctions& c = cairo();
  const auto set = [&](cairo_pdf_metadata_t what, const std::string& text) {
    if (!text.empty()) c.cairo_pdf_surface_set_metadata(surface, what, text.c_str());
  };
  const std::string date = date_of_creation();
  set(CAIRO_PDF_METADATA_CREATE_DATE, date);
  set(CAIRO_PDF_METADATA_MOD_DATE, date);
  if (origin == nullptr) return;
  std::string keywords;
  for (const auto& [key, value] : entries_of(*origin)) {
    if (key == "Title" || key == "Software" || key == "Command") continue;
    keywords += (keywords.empty() ? "" : ", ") + key + ": " + value;
  }
  set(CAIRO_PDF_METADATA_TITLE, origin->title);
  set(CAIRO_PDF_METADATA_SUBJECT, origin->command);  // command that reproduces it
  set(CAIRO_PDF_METADATA_KEYWORDS, keywords);
  set(CAIRO_PDF_METADATA_CREATOR, "contactscope " + origin->version);
}

}  // namespace

void require_pdf() { cairo(); }

std::string pdf_of(const draw::Drawing& drawing, const PdfOptions& options) {
  // FreeType faces are not thread-safe.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const CairoFunctions& c = cairo();
  static Fonts fonts;
  std::string bytes;
  const double scale = drawing.points_per_pixel;
  const Owned<cairo_surface_t> surface(
      c.cairo_pdf_surface_create_for_stream(write_to, &bytes, scale * drawing.width,
                                            scale * drawing.height),
      c.cairo_surface_destroy);
  check(c.cairo_surface_status(surface.get()));
  // Later versions pack all but the pictures, so that no text of them can be found in the file.
  c.cairo_pdf_surface_restrict_to_version(surface.get(), CAIRO_PDF_VERSION_1_4);
  set_metadata(surface.get(), options.origin);
  {
    const Owned<cairo_t> page(c.cairo_create(surface.get()), c.cairo_destroy);
    const Owned<cairo_font_options_t> font_options(c.cairo_font_options_create(),
                                                   c.cairo_font_options_destroy);
    c.cairo_font_options_set_hint_style(font_options.get(), CAIRO_HINT_STYLE_NONE);
    c.cairo_font_options_set_hint_metrics(font_options.get(), CAIRO_HINT_METRICS_OFF);
    c.cairo_set_font_options(page.get(), font_options.get());
    c.cairo_scale(page.get(), scale, scale);
    c.cairo_set_line_join(page.get(), CAIRO_LINE_JOIN_ROUND);
    const PdfWriter writer{c, page.get(), fonts};
    if (drawing.background.a > 0) {
      writer.set_color(drawing.background);
      c.cairo_paint(page.get());
    }
    for (const Group& group : groups_of(drawing)) {
      const bool surfaces = group.part != nullptr && group.part->role == "surface";
      for (const Piece& piece : group.pieces)
        std::visit([&](const auto& shape) { writer.add(shape, surfaces); }, piece);
    }
    check(c.cairo_status(page.get()));
  }
  c.cairo_surface_finish(surface.get());
  check(c.cairo_surface_status(surface.get()));
  return bytes;
}

}  // namespace contactscope::vector

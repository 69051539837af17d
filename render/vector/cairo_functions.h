#pragma once

#include <cairo-ft.h>
#include <cairo-pdf.h>

#include "vector/font_subset.h"

namespace contactscope::vector {

// Functions of cairo and its dependency FreeType that pdf.cpp uses.
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

}  // namespace contactscope::vector

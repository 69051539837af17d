#pragma once

#include "image/png.h"
#include "vector/font_subset.h"

/// SVG syntax.
namespace contactscope::vector {

struct SvgOptions {
  const PictureOrigin* origin = nullptr;  // written as metadata
  FontFaces* fonts = nullptr;             // shared by a sequence; null: for this picture only
  bool embed_font = true;                 // false: for a page that embeds the font once
  std::string id_prefix{};                // for every id, if a page has several pictures
  /// Size of the picture as SVG lengths; empty: the size of its pixels on paper.
  std::string width{}, height{};
};

/// Writes SVG 1.1, with features of SVG 2 that browsers, Inkscape and librsvg support:
///
/// - A group for each run of primitives of one part:
///   <g id="contacts" class="layer contacts" data-pair="table crate" data-role="mark">. Its id is
///   the layer's name, or "panel-summary" for panels and insets; later runs get "contacts-2", ...
/// - Live text in the embedded font, with a subset for each weight.
/// - Neighbouring polygons of surfaces have no soft edges, as in pixels, to avoid seams.
/// - Two decimals; equal drawings give equal bytes. The size is that of the pixels on paper: CSS
///   pixels, or points for pixels of another size.
///
/// Throws MissingLibrary if the font is to be embedded and libharfbuzz-subset is missing.
std::string svg_of(const draw::Drawing& drawing, const SvgOptions& options = {});

/// In its shortest form, with at most two decimals: "-.5", "12", "0".
std::string number(double value);

/// "#d55e00", or its short form "#fff"; ignores alpha.
std::string hex(const draw::Color& color);

/// Escapes text for XML and HTML. Control characters become spaces, because XML forbids them;
/// noncharacters and invalid UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

/// Escapes JSON for a <script> element of HTML; it stays equivalent JSON. Characters with a meaning
/// in HTML or old JavaScript (<, >, &, U+2028, U+2029) become \u003c, ... They occur only in
/// strings.
std::string in_script(std::string_view json);

struct PdfOptions {
  const PictureOrigin* origin = nullptr;  // written as metadata
};

/// Opens libcairo ahead of pdf_of(); throws MissingLibrary (font_subset.h).
void require_pdf();

/// One PDF page, written by libcairo with the same pieces as SVG (pieces.h), in the drawing's size.
/// Text is searchable and uses embedded font subsets. The creation date is SOURCE_DATE_EPOCH
/// (seconds since 1970), or 1970 if unset, so equal drawings give equal bytes with the same version
/// of cairo. Throws MissingLibrary like require_pdf().
std::string pdf_of(const draw::Drawing& drawing, const PdfOptions& options = {});

}  // namespace contactscope::vector

#pragma once

#include <string>

#include "draw/scene/drawing.h"
#include "image/picture_origin.h"
#include "vector/font_subset.h"

namespace contactscope::vector {

struct SvgOptions {
  const PictureOrigin* origin = nullptr;  // written as metadata
  FontFaces* fonts = nullptr;             // of the sequence; null: of this picture alone
  bool embed_font = true;                 // false: in a page that has the font once
  std::string id_prefix{};                // before every id, where several stand in one page
  /// Of the whole picture, as SVG spells lengths; empty: as large as its pixels are on paper.
  std::string width{}, height{};
};

/// The drawing as a file of SVG 1.1 with what browsers, Inkscape and librsvg know of SVG 2:
///
/// - A group for each run of primitives of one part:
///   <g id="contacts" class="layer contacts" data-pair="table crate" data-role="mark">. An id is the
///   layer's name, of a panel or inset "panel-summary"; the second run has "contacts-2", and so on.
/// - Live text in the embedded font, of which it holds the letters that it uses, each weight by itself.
/// - Nothing that is not seen (pieces.h). Neighbouring polygons of surfaces are painted without soft
///   edges, as in pixels, so that no seam shows.
/// - Places with two decimals; equal drawings give equal bytes. It is as large as the drawing's pixels
///   are on paper: in pixels of CSS, or in points where they are of another size.
///
/// Throws MissingLibrary where the font is to be embedded and libharfbuzz-subset is not installed.
std::string svg_of(const draw::Drawing& drawing, const SvgOptions& options = {});

}  // namespace contactscope::vector

#pragma once

#include <string>

#include "draw/scene/drawing.h"
#include "image/picture_origin.h"

namespace contactscope::vector {

struct PdfOptions {
  const PictureOrigin* origin = nullptr;  // written as metadata
};

/// Opens libcairo, which pdf_of() would do at its first call; throws MissingLibrary (font_subset.h) where
/// there is none.
void require_pdf();

/// The drawing as one page of PDF, written by libcairo: the same pieces as in SVG (pieces.h), text that
/// can be searched and copied in embedded subsets of the font. The page is as large as the drawing says. The date of creation is that of
/// SOURCE_DATE_EPOCH (seconds since 1970), or 1970 where that is not set: equal drawings give equal bytes,
/// as long as cairo is the same.
/// Throws MissingLibrary as require_pdf() does.
std::string pdf_of(const draw::Drawing& drawing, const PdfOptions& options = {});

}  // namespace contactscope::vector

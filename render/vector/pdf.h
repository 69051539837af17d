#pragma once

#include "draw/scene/drawing.h"
#include "image/png.h"

namespace contactscope::vector {

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

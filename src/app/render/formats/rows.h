#pragma once

#include "app/render/formats/format.h"

namespace contactscope::app {

// Each is defined in the file of its name.
extern const Format kPngFormat, kSvgFormat, kPdfFormat, kHtmlFormat, kApngFormat, kWebpFormat,
    kMp4Format, kViewerFormat;

}  // namespace contactscope::app

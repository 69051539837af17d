#include "app/render/formats/format.h"
#include "vector/pdf.h"

namespace contactscope::app {

const Format kPdfFormat{
    .name = "pdf",
    .extension = ".pdf",
    .what = "a page of vectors, one file per frame",
    .encode =
        [](const Shot& shot) {
          const std::string pdf = vector::pdf_of(*shot.drawing, {.origin = &shot.origin});
          return std::vector<std::uint8_t>(pdf.begin(), pdf.end());
        },
    .require = &vector::require_pdf,
};

}  // namespace contactscope::app

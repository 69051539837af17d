#include "app/formats/rows.h"
#include "vector/pdf.h"

namespace contactscope::app {

const Format kPdfFormat{
    .name = "pdf",
    .extension = ".pdf",
    .what = "a page of vectors, a file a frame",
    .encode =
        [](const Shot& shot) {
          const std::string pdf = vector::pdf_of(
              *shot.drawing,
              {.origin = &shot.origin, .points_per_pixel = shot.drawing->points_per_pixel});
          return std::vector<std::uint8_t>(pdf.begin(), pdf.end());
        },
};

}  // namespace contactscope::app

#include "app/cli/verbs.h"
#include "app/render/formats/rows.h"
#include "vector/font_subset.h"
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
    .require =
        [] {
          try {
            vector::require_pdf();
          } catch (const vector::MissingLibrary& missing) {
            throw UsageError(std::string("--format pdf: ") + missing.what());
          }
        },
};

}  // namespace contactscope::app

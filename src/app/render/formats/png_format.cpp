#include "app/render/formats/format.h"
#include "image/png.h"

namespace contactscope::app {

const Format kPngFormat{
    .name = "png",
    .extension = ".png",
    .what = "pixels, one file per frame",
    .needs_pixels = true,
    .encode =
        [](const Shot& shot) {
          return encode_png(*shot.image, kFastestDeflate, entries_of(shot.origin));
        },
};

}  // namespace contactscope::app

#include "app/render/formats/format.h"
#include "vector/svg.h"

namespace contactscope::app {

const Format kSvgFormat{
    .name = "svg",
    .extension = ".svg",
    .what = "vectors with live text, one file per frame",
    .encode =
        [](const Shot& shot) {
          static vector::FontFaces faces;  // shared: pictures of a run use the same glyphs
          const std::string svg =
              vector::svg_of(*shot.drawing, {.origin = &shot.origin, .fonts = &faces});
          return std::vector<std::uint8_t>(svg.begin(), svg.end());
        },
    .require = &vector::require_font_subsets,
};

}  // namespace contactscope::app

#include <cstdio>

#include "app/formats/rows.h"
#include "vector/svg.h"

namespace contactscope::app {
namespace {

/// "238.11pt" of what has a size on paper; empty where a pixel is one of the screen, as SVG takes it.
std::string on_paper(int pixels, double points_per_pixel) {
  constexpr double kOfScreen = 0.75;
  if (points_per_pixel == kOfScreen) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.2fpt", pixels * points_per_pixel);
  return text;
}

}  // namespace

const Format kSvgFormat{
    .name = "svg",
    .extension = ".svg",
    .what = "vectors with live text, a file a frame",
    .encode =
        [](const Shot& shot) {
          const draw::Drawing& drawing = *shot.drawing;
          vector::SvgOptions options{.origin = &shot.origin};
          options.width = on_paper(drawing.width, drawing.points_per_pixel);
          options.height = on_paper(drawing.height, drawing.points_per_pixel);
          const std::string svg = vector::svg_of(drawing, options);
          return std::vector<std::uint8_t>(svg.begin(), svg.end());
        },
};

}  // namespace contactscope::app

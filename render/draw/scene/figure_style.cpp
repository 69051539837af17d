#include "draw/scene/figure_style.h"

#include <algorithm>

namespace contactscope::draw {
namespace {

void widen(Primitive& primitive, float factor) {
  if (Stroke* const stroke = std::get_if<Stroke>(&primitive)) {
    stroke->width *= factor;
  } else if (Disc* const disc = std::get_if<Disc>(&primitive); disc != nullptr && disc->inner > 0) {
    // A ring is a circular line, widened around its middle radius.
    const float middle = 0.5f * (disc->inner + disc->outer);
    const float half = 0.5f * factor * (disc->outer - disc->inner);
    disc->inner = std::max(0.0f, middle - half);
    disc->outer = middle + half;
  }
}

}  // namespace

void finish(const FigureStyle& style, Drawing& drawing) {
  drawing.points_per_pixel = style.points_per_pixel;
  if (style.line_width != 1) {
    for (Primitive& primitive : drawing.primitives)
      widen(primitive, static_cast<float>(style.line_width));
  }
  if (style.theme != Theme::Light || style.background)
    apply_theme(style.theme, style.background, drawing);
}

}  // namespace contactscope::draw

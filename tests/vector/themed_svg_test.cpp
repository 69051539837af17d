#include <gtest/gtest.h>

#include <regex>

#include "draw/crate_on_slab.h"
#include "draw/scene/layout.h"
#include "vector/svg.h"

namespace contactscope::vector {
namespace {

std::string without_colors(const std::string& svg) {
  static const std::regex color(
      R"re( (fill|stroke|fill-opacity|stroke-opacity)="[#0-9a-fA-F.]+")re");
  return std::regex_replace(svg, color, "");
}

TEST(ThemedSvg, IsEqualByteForByteButForColours) {
  const draw::crate_sample::CrateOnSlab scene;
  draw::Drawing drawing = illustrate(scene.staged(), scene.frames[0]);
  const std::string light = svg_of(drawing, {.embed_font = false});
  EXPECT_NE(without_colors(light), light);
  for (const draw::Theme theme : {draw::Theme::Dark, draw::Theme::Grey, draw::Theme::Print}) {
    draw::Drawing themed = drawing;
    apply_theme(theme, {}, themed);
    const std::string svg = svg_of(themed, {.embed_font = false});
    EXPECT_NE(svg, light);
    EXPECT_EQ(without_colors(svg), without_colors(light));
  }
}

}  // namespace
}  // namespace contactscope::vector

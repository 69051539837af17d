// Paints the sample drawing and writes its pixels to standard output, then GL_RENDERER:
//   paint_sample egl|osmesa WIDTH HEIGHT
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "gl/context.h"
#include "gl/rasterizer.h"
#include "gl/sample_drawing.h"

int main(int count, char** arguments) try {
  namespace gl = contactscope::gl;
  if (count != 4) return 2;
  const bool osmesa = std::string_view(arguments[1]) == "osmesa";
  const auto context = gl::open_context(osmesa ? gl::Backend::Osmesa : gl::Backend::Egl);
  const int width = std::atoi(arguments[2]), height = std::atoi(arguments[3]);
  gl::Rasterizer rasterizer(*context, width, height);
  rasterizer.paint(contactscope::testing::sample_drawing(width, height));
  const contactscope::Image image = rasterizer.read();
  std::fwrite(image.rgb.data(), 1, image.rgb.size(), stdout);
  std::fputs(reinterpret_cast<const char*>(context->functions().GetString(GL_RENDERER)), stdout);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "paint_sample: %s\n", error.what());
  return 1;
}

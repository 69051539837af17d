#pragma once

#include <memory>

#include "draw/scene/drawing.h"
#include "gl/context.h"
#include "image/image.h"

namespace contactscope::gl {

/// Paints drawings into an off-screen framebuffer of a fixed size and reads it back. Everything is
/// screen-space triangles with coverage computed in the fragment shader, so pixels do not depend on
/// a driver's wide lines or sample patterns.
///
/// Steps of a frame: begin() clears; paint() draws primitives in order with as few draw calls as
/// the glyph atlas allows; read() copies out, top row first. Colours mix in sRGB as the bytes stand. The framebuffer's row 0 is the picture's top.
///
/// The context outlives the rasterizer and is made current on each call. The constructor throws
/// std::runtime_error where the driver refuses the size or a shader; read() where drawing failed.
class Rasterizer {
 public:
  Rasterizer(Context& context, int width, int height);
  ~Rasterizer();
  Rasterizer(const Rasterizer&) = delete;
  Rasterizer& operator=(const Rasterizer&) = delete;

  void begin(const draw::Color& background);
  void paint(const draw::Drawing& drawing);
  Image read();

  unsigned framebuffer() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contactscope::gl

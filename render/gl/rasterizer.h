#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "draw/scene/drawing.h"
#include "gl/context.h"
#include "gl/primitive_vertices.h"
#include "image/image.h"

namespace contactscope::gl {

/// Paints drawings into an off-screen framebuffer of a fixed size and reads it back. Everything is
/// screen-space triangles with coverage computed in the fragment shader, so pixels do not depend on
/// a driver's wide lines or sample patterns. Colours mix in sRGB as the bytes stand. The
/// framebuffer's row 0 is the picture's top.
///
/// The context outlives the rasterizer and is made current on each call. The constructor throws
/// std::runtime_error where the driver refuses the size or a shader; read() where drawing failed.
class Rasterizer {
 public:
  Rasterizer(Context& context, int width, int height);
  ~Rasterizer();
  Rasterizer(const Rasterizer&) = delete;
  Rasterizer& operator=(const Rasterizer&) = delete;

  /// Clears to the drawing's background and paints its primitives in order, with as few draw calls
  /// as the glyph atlas allows.
  void paint(const draw::Drawing& drawing);
  /// Copies out, top row first; with alpha where the drawing had a background that let something
  /// through.
  Image read();

 private:
  void make_framebuffer();
  void make_programs();
  void make_vertex_array();
  void upload_glyphs();

  Context& context_;
  const Functions& gl_;
  const int width_, height_;
  GLuint framebuffer_ = 0, colors_ = 0;
  GLuint vertex_array_ = 0, vertices_ = 0, indices_ = 0;
  std::array<GLuint, 3> programs_{};  // by Painter
  std::vector<GLuint> pages_;         // textures of the glyph atlas
  PrimitiveVertices triangles_;
  std::vector<std::uint8_t> rgba_;
  bool opaque_ = true;  // what was painted last
};

}  // namespace contactscope::gl

#pragma once

#include "gl/context.h"
#include "gl/primitive_vertices.h"
#include "image/image.h"

namespace contactscope::gl {

/// Paints drawings into an off-screen framebuffer of fixed size and reads it back. All primitives
/// are screen-space triangles with coverage computed in the fragment shader, so pixels do not
/// depend on a driver's wide lines or sample patterns. Colours blend in sRGB without linearization.
/// The framebuffer's row 0 is the picture's top.
///
/// The context must outlive the rasterizer; each call makes it current. The constructor throws
/// std::runtime_error if the driver rejects the size or a shader, read() if drawing failed.
class Rasterizer {
 public:
  Rasterizer(Context& context, int width, int height);
  ~Rasterizer();
  Rasterizer& operator=(Rasterizer&&) = delete;

  /// Clears to the drawing's background and paints its primitives in order, with as few draw calls
  /// as the glyph atlas allows.
  void paint(const draw::Drawing& drawing);
  /// Reads the picture, top row first, with alpha if the background was not opaque.
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
  bool opaque_ = true;  // the last background
};

}  // namespace contactscope::gl

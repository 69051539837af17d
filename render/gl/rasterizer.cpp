#include "gl/rasterizer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "gl/functions.h"
#include "gl/glyph_atlas.h"
#include "gl/primitive_vertices.h"
#include "gl/program.h"
#include "gl/shaders.h"
#include "gl/vertex_array.h"

namespace contactscope::gl {

struct Rasterizer::Impl {
  Impl(Context& owner, int w, int h);
  ~Impl();

  void make_framebuffer();
  void make_programs();
  void upload_glyphs();
  void draw_batches();

  Context& context;
  const Functions& gl;
  const int width, height;
  GLuint framebuffer = 0, colors = 0;
  VertexArray vertices;
  std::array<GLuint, 3> programs{};  // by Painter
  std::vector<GLuint> pages;         // textures of the glyph atlas
  GlyphAtlas atlas;
  PrimitiveVertices scratch;
  std::vector<std::uint8_t> rgba;
};

Rasterizer::Impl::Impl(Context& owner, int w, int h)
    : context(owner), gl(owner.functions()), width(w), height(h) {
  if (width <= 0 || height <= 0)
    throw std::invalid_argument("a picture needs a width and a height");
  context.make_current();
  make_framebuffer();
  make_programs();
  vertices = make_vertex_array(gl, sizeof(Vertex),
                               {{2, GL_FLOAT, GL_FALSE, offsetof(Vertex, position)},
                                {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, color)},
                                {4, GL_FLOAT, GL_FALSE, offsetof(Vertex, line)},
                                {4, GL_FLOAT, GL_FALSE, offsetof(Vertex, form)},
                                {3, GL_FLOAT, GL_FALSE, offsetof(Vertex, run)}});
}

Rasterizer::Impl::~Impl() {
  context.make_current();
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.DeleteRenderbuffers(1, &colors);
  delete_vertex_array(gl, vertices);
  for (const GLuint program : programs) gl.DeleteProgram(program);
  gl.DeleteTextures(static_cast<GLsizei>(pages.size()), pages.data());
}

void Rasterizer::Impl::make_framebuffer() {
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenRenderbuffers(1, &colors);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.BindRenderbuffer(GL_RENDERBUFFER, colors);
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colors);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("the driver has no framebuffer of " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels");
  }
}

void Rasterizer::Impl::make_programs() {
  const char* fragments[] = {kFillFragmentShader, kShapeFragmentShader, kGlyphFragmentShader};
  for (std::size_t i = 0; i < programs.size(); ++i) {
    programs[i] = build_program(gl, kVertexShader, fragments[i],
                                {"position", "color", "line", "form", "run"});
    gl.UseProgram(programs[i]);
    gl.Uniform2f(gl.GetUniformLocation(programs[i], "pixel"), 2.0f / static_cast<float>(width),
                 2.0f / static_cast<float>(height));
  }
}

/// Copies the rows of the atlas that changed since the last frame.
void Rasterizer::Impl::upload_glyphs() {
  gl.ActiveTexture(GL_TEXTURE0);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t i = 0; i < atlas.pages().size(); ++i) {
    GlyphAtlas::Page& page = atlas.pages()[i];
    if (i == pages.size()) {
      GLuint texture = 0;
      gl.GenTextures(1, &texture);
      gl.BindTexture(GL_TEXTURE_2D, texture);
      gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, GlyphAtlas::kSide, GlyphAtlas::kSide, 0, GL_RED,
                    GL_UNSIGNED_BYTE, nullptr);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
      pages.push_back(texture);
    }
    if (page.changed_from == page.changed_to) continue;
    gl.BindTexture(GL_TEXTURE_2D, pages[i]);
    gl.TexSubImage2D(
        GL_TEXTURE_2D, 0, 0, page.changed_from, GlyphAtlas::kSide,
        page.changed_to - page.changed_from, GL_RED, GL_UNSIGNED_BYTE,
        &page.coverage[static_cast<std::size_t>(page.changed_from) * GlyphAtlas::kSide]);
    page.changed_from = page.changed_to = 0;
  }
}

void Rasterizer::Impl::draw_batches() {
  gl.BindVertexArray(vertices.array);
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices.vertices);
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(scratch.vertices.size() * sizeof(Vertex)),
                scratch.vertices.data(), GL_STREAM_DRAW);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(scratch.indices.size() * sizeof(std::uint32_t)),
                scratch.indices.data(), GL_STREAM_DRAW);
  for (const Batch& batch : scratch.batches) {
    gl.UseProgram(programs[static_cast<std::size_t>(batch.painter)]);
    if (batch.painter == Painter::Glyph) {
      gl.BindTexture(GL_TEXTURE_2D, pages[static_cast<std::size_t>(batch.page)]);
    }
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.count), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(batch.first * sizeof(std::uint32_t)));
  }
}

Rasterizer::Rasterizer(Context& context, int width, int height)
    : impl_(std::make_unique<Impl>(context, width, height)) {}
Rasterizer::~Rasterizer() = default;

unsigned Rasterizer::framebuffer() const {
  return impl_->framebuffer;
}

void Rasterizer::begin(const draw::Color& background) {
  impl_->context.make_current();
  const Functions& gl = impl_->gl;
  gl.BindFramebuffer(GL_FRAMEBUFFER, impl_->framebuffer);
  gl.Viewport(0, 0, impl_->width, impl_->height);
  gl.Disable(GL_SCISSOR_TEST);
  gl.ClearColor(background.r, background.g, background.b, background.a);
  gl.Clear(GL_COLOR_BUFFER_BIT);
}

void Rasterizer::paint(const draw::Drawing& drawing) {
  impl_->context.make_current();
  impl_->scratch.clear();
  for (const draw::Primitive& primitive : drawing.primitives) {
    impl_->scratch.append(primitive, impl_->atlas);
  }
  const Functions& gl = impl_->gl;
  gl.BindFramebuffer(GL_FRAMEBUFFER, impl_->framebuffer);
  gl.Viewport(0, 0, impl_->width, impl_->height);
  gl.Disable(GL_SCISSOR_TEST);
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_CULL_FACE);
  // Mixed as the bytes stand, without linearizing: a half transparent #0072B2 on white is what
  // every other tool makes of it.
  gl.Enable(GL_BLEND);
  gl.BlendEquation(GL_FUNC_ADD);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  impl_->upload_glyphs();
  impl_->draw_batches();
}

Image Rasterizer::read() {
  impl_->context.make_current();
  const Functions& gl = impl_->gl;
  const std::size_t pixels =
      static_cast<std::size_t>(impl_->width) * static_cast<std::size_t>(impl_->height);
  impl_->rgba.resize(4 * pixels);
  gl.BindFramebuffer(GL_FRAMEBUFFER, impl_->framebuffer);
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  // As stored, and packed below: drivers convert to GL_RGB pixel by pixel.
  gl.ReadPixels(0, 0, impl_->width, impl_->height, GL_RGBA, GL_UNSIGNED_BYTE, impl_->rgba.data());
  if (gl.GetError() != GL_NO_ERROR) throw std::runtime_error("OpenGL failed to paint a picture");
  Image image(impl_->width, impl_->height);
  const std::uint8_t* from = impl_->rgba.data();
  std::uint8_t* to = image.rgb.data();
  // Four bytes at once are one move each; the next pixel overwrites the fourth.
  for (std::size_t i = 1; i < pixels; ++i, from += 4, to += 3) std::memcpy(to, from, 4);
  std::memcpy(to, from, 3);
  return image;
}

}  // namespace contactscope::gl

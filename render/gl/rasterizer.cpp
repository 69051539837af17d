#include "gl/rasterizer.h"

namespace contactscope::gl {

/// shaders/*.glsl, embedded by the build.
std::string_view vertex_shader();
std::string_view fill_shader();
std::string_view shape_shader();
std::string_view glyph_shader();

namespace {

/// An input of the vertex shader; its location is its index in the list.
struct Attribute {
  const char* name;
  GLint components;
  GLenum type;
  GLboolean normalized;
  std::size_t offset;  // bytes from the start of a vertex
};
constexpr Attribute kAttributes[] = {
    {"position", 2, GL_FLOAT, GL_FALSE, offsetof(Vertex, position)},
    {"color", 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, color)},
    {"line", 4, GL_FLOAT, GL_FALSE, offsetof(Vertex, line)},
    {"form", 4, GL_FLOAT, GL_FALSE, offsetof(Vertex, form)},
    {"run", 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, run)},
};

/// Throws std::runtime_error with the log of a shader or program.
template <class GetLog>
[[noreturn]] void reject(const std::string& what, GLuint object, const GetLog& get_log) {
  std::string log(4096, '\0');
  GLsizei length = 0;
  get_log(object, static_cast<GLsizei>(log.size()), &length, log.data());
  throw std::runtime_error(what + log.substr(0, static_cast<std::size_t>(length)));
}

void attach(const Functions& gl, GLuint program, GLenum kind, std::string_view source) {
  const GLuint shader = gl.CreateShader(kind);
  const char* const text = source.data();
  const auto length = static_cast<GLint>(source.size());
  gl.ShaderSource(shader, 1, &text, &length);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (!compiled) reject("the driver rejects a shader: ", shader, gl.GetShaderInfoLog);
  gl.AttachShader(program, shader);
  gl.DeleteShader(shader);  // deleted with the program
}

/// Compiles and links GLSL 3.30. Throws std::runtime_error with the driver's log.
GLuint build_program(const Functions& gl, std::string_view fragment_source) {
  const GLuint program = gl.CreateProgram();
  attach(gl, program, GL_VERTEX_SHADER, vertex_shader());
  attach(gl, program, GL_FRAGMENT_SHADER, fragment_source);
  GLuint location = 0;
  for (const Attribute& attribute : kAttributes)
    gl.BindAttribLocation(program, location++, attribute.name);
  gl.LinkProgram(program);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked) reject("the driver cannot link a program: ", program, gl.GetProgramInfoLog);
  return program;
}

/// Converts from colours premultiplied by alpha.
Image straight(const std::vector<std::uint8_t>& rgba, int width, int height) {
  Image image(width, height);
  image.alpha.resize(rgba.size() / 4);
  for (std::size_t i = 0; i < image.alpha.size(); ++i) {
    const unsigned alpha = image.alpha[i] = rgba[4 * i + 3];
    for (std::size_t c = 0; c < 3 && alpha > 0; ++c) {
      const unsigned channel = rgba[4 * i + c];
      image.rgb[3 * i + c] =
          static_cast<std::uint8_t>(std::min(255u, (255 * channel + alpha / 2) / alpha));
    }
  }
  return image;
}

}  // namespace

Rasterizer::Rasterizer(Context& context, int width, int height)
    : context_(context), gl_(context.functions()), width_(width), height_(height) {
  if (width <= 0 || height <= 0)
    throw std::invalid_argument("a picture needs a width and a height");
  context.make_current();
  make_framebuffer();
  make_programs();
  make_vertex_array();
}

Rasterizer::~Rasterizer() {
  context_.make_current();
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteRenderbuffers(1, &colors_);
  gl_.DeleteBuffers(1, &indices_);
  gl_.DeleteBuffers(1, &vertices_);
  gl_.DeleteVertexArrays(1, &vertex_array_);
  for (const GLuint program : programs_) gl_.DeleteProgram(program);
  gl_.DeleteTextures(static_cast<GLsizei>(pages_.size()), pages_.data());
}

void Rasterizer::make_framebuffer() {
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.GenRenderbuffers(1, &colors_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.BindRenderbuffer(GL_RENDERBUFFER, colors_);
  gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width_, height_);
  gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colors_);
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error("the driver has no framebuffer of " + std::to_string(width_) + " x " +
                             std::to_string(height_) + " pixels");
  }
}

void Rasterizer::make_programs() {
  const std::string_view fragments[] = {fill_shader(), shape_shader(), glyph_shader()};
  for (std::size_t i = 0; i < programs_.size(); ++i) {
    programs_[i] = build_program(gl_, fragments[i]);
    gl_.UseProgram(programs_[i]);
    gl_.Uniform2f(gl_.GetUniformLocation(programs_[i], "pixel"), 2.0f / static_cast<float>(width_),
                  2.0f / static_cast<float>(height_));
  }
}

void Rasterizer::make_vertex_array() {
  gl_.GenVertexArrays(1, &vertex_array_);
  gl_.GenBuffers(1, &vertices_);
  gl_.GenBuffers(1, &indices_);
  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  GLuint location = 0;
  for (const Attribute& attribute : kAttributes) {
    gl_.EnableVertexAttribArray(location);
    gl_.VertexAttribPointer(location++, attribute.components, attribute.type, attribute.normalized,
                            sizeof(Vertex), reinterpret_cast<const void*>(attribute.offset));
  }
}

/// Uploads the rows of the atlas that changed since the last frame.
void Rasterizer::upload_glyphs() {
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t i = 0; i < triangles_.atlas.pages().size(); ++i) {
    GlyphAtlas::Page& page = triangles_.atlas.pages()[i];
    if (i == pages_.size()) {
      GLuint texture = 0;
      gl_.GenTextures(1, &texture);
      gl_.BindTexture(GL_TEXTURE_2D, texture);
      gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, GlyphAtlas::kSide, GlyphAtlas::kSide, 0, GL_RED,
                     GL_UNSIGNED_BYTE, nullptr);
      gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
      gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
      pages_.push_back(texture);
    }
    if (page.changed_from == page.changed_to) continue;
    gl_.BindTexture(GL_TEXTURE_2D, pages_[i]);
    gl_.TexSubImage2D(
        GL_TEXTURE_2D, 0, 0, page.changed_from, GlyphAtlas::kSide,
        page.changed_to - page.changed_from, GL_RED, GL_UNSIGNED_BYTE,
        &page.coverage[static_cast<std::size_t>(page.changed_from) * GlyphAtlas::kSide]);
    page.changed_from = page.changed_to = 0;
  }
}

void Rasterizer::paint(const draw::Drawing& drawing) {
  context_.make_current();
  triangles_.clear();
  for (const draw::Primitive& primitive : drawing.primitives) triangles_.append(primitive);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.Disable(GL_SCISSOR_TEST);
  const draw::Color& background = drawing.background;
  // The blending below keeps colours premultiplied by coverage if the background is.
  opaque_ = background.a >= 1;
  gl_.ClearColor(background.a * background.r, background.a * background.g,
                 background.a * background.b, background.a);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  // Blends sRGB bytes without linearizing, so that half transparent #0072B2 on white looks as in
  // other tools.
  gl_.Enable(GL_BLEND);
  gl_.BlendEquation(GL_FUNC_ADD);
  gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  upload_glyphs();
  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_);
  const auto fill = [&](GLenum target, const auto& data) {
    gl_.BufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(data[0])), data.data(),
                   GL_STREAM_DRAW);
  };
  fill(GL_ARRAY_BUFFER, triangles_.vertices);
  fill(GL_ELEMENT_ARRAY_BUFFER, triangles_.indices);
  for (const Batch& batch : triangles_.batches) {
    gl_.UseProgram(programs_[static_cast<std::size_t>(batch.painter)]);
    if (batch.painter == Painter::Glyph)
      gl_.BindTexture(GL_TEXTURE_2D, pages_[static_cast<std::size_t>(batch.page)]);
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(batch.count), GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(batch.first * sizeof(std::uint32_t)));
  }
}

Image Rasterizer::read() {
  context_.make_current();
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  rgba_.resize(4 * pixels);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
  // Read RGBA and pack it below: drivers convert to GL_RGB pixel by pixel.
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  if (gl_.GetError() != GL_NO_ERROR) throw std::runtime_error("OpenGL failed to paint a picture");
  if (!opaque_) return straight(rgba_, width_, height_);
  Image image(width_, height_);
  const std::uint8_t* from = rgba_.data();
  std::uint8_t* to = image.rgb.data();
  // Copy four bytes at once; the next pixel overwrites the fourth.
  for (std::size_t i = 1; i < pixels; ++i, from += 4, to += 3) std::memcpy(to, from, 4);
  std::memcpy(to, from, 3);
  return image;
}

}  // namespace contactscope::gl

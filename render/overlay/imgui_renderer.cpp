#include "overlay/imgui_renderer.h"

#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "gl/functions.h"
#include "gl/program.h"
#include "gl/vertex_array.h"
#include "overlay/imgui_style.h"

namespace contactscope::overlay {
namespace {

// The framebuffer's row 0 is the picture's top row, as in gl/shaders.h.
constexpr const char* kVertexShader = R"(#version 330 core
in vec2 position;  // pixels from the top left
in vec2 texel;     // 0 to 1 in the font texture
in vec4 color;
out vec2 frag_texel;
out vec4 frag_color;
uniform vec2 pixel;  // 2 / size
void main() {
  frag_texel = texel;
  frag_color = color;
  gl_Position = vec4(position * pixel - 1.0, 0.0, 1.0);
}
)";

// The font texture holds coverage alone; ImGui draws shapes from a white texel in it.
constexpr const char* kFragmentShader = R"(#version 330 core
in vec2 frag_texel;
in vec4 frag_color;
uniform sampler2D font;
out vec4 fragment;
void main() {
  fragment = vec4(frag_color.rgb, frag_color.a * texture(font, frag_texel).r);
}
)";

}  // namespace

struct PanelRenderer::Impl {
  Impl(gl::Context& owner, int w, int h, float scale);
  ~Impl();

  void make_program();
  void make_font_texture();
  void set_state();
  void draw(const ImDrawData& data);
  void draw_list(const ImDrawList& list);

  gl::Context& context;
  const gl::Functions& gl;
  const int width, height;
  ImGuiContext* imgui = nullptr;
  GLuint program = 0, font_texture = 0;
  gl::VertexArray vertices;
};

PanelRenderer::Impl::Impl(gl::Context& owner, int w, int h, float scale)
    : context(owner), gl(owner.functions()), width(w), height(h) {
  IMGUI_CHECKVERSION();
  context.make_current();
  make_program();
  imgui = ImGui::CreateContext();
  ImGui::SetCurrentContext(imgui);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // neither read nor left behind
  io.LogFilename = nullptr;
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DeltaTime = 1.0f / 60;
  io.BackendRendererName = "contactscope";
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  apply_style(ImGui::GetStyle(), scale);
  make_font_texture();
  vertices = gl::make_vertex_array(gl, sizeof(ImDrawVert),
                                   {{2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos)},
                                    {2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv)},
                                    {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col)}});
}

PanelRenderer::Impl::~Impl() {
  context.make_current();
  gl.DeleteProgram(program);
  gl.DeleteTextures(1, &font_texture);
  gl::delete_vertex_array(gl, vertices);
  ImGui::DestroyContext(imgui);
}

void PanelRenderer::Impl::make_program() {
  program = gl::build_program(gl, kVertexShader, kFragmentShader, {"position", "texel", "color"});
  gl.UseProgram(program);
  gl.Uniform2f(gl.GetUniformLocation(program, "pixel"), 2.0f / static_cast<float>(width),
               2.0f / static_cast<float>(height));
}

void PanelRenderer::Impl::make_font_texture() {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  unsigned char* coverage = nullptr;
  int texture_width = 0, texture_height = 0;
  fonts.GetTexDataAsAlpha8(&coverage, &texture_width, &texture_height);
  gl.GenTextures(1, &font_texture);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, font_texture);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, texture_width, texture_height, 0, GL_RED, GL_UNSIGNED_BYTE,
                coverage);
  fonts.SetTexID(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(font_texture)));
  fonts.ClearTexData();
}

void PanelRenderer::Impl::set_state() {
  gl.Viewport(0, 0, width, height);
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_CULL_FACE);
  gl.Enable(GL_SCISSOR_TEST);
  gl.Enable(GL_BLEND);
  gl.BlendEquation(GL_FUNC_ADD);
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl.UseProgram(program);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, font_texture);
  gl.BindVertexArray(vertices.array);
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices.vertices);
}

void PanelRenderer::Impl::draw(const ImDrawData& data) {
  context.make_current();
  set_state();
  for (int i = 0; i < data.CmdListsCount; ++i) draw_list(*data.CmdLists[i]);
  gl.Disable(GL_SCISSOR_TEST);
}

void PanelRenderer::Impl::draw_list(const ImDrawList& list) {
  gl.BufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data,
                GL_STREAM_DRAW);
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data,
                GL_STREAM_DRAW);
  constexpr GLenum kIndexType = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
  for (const ImDrawCmd& command : list.CmdBuffer) {
    if (command.UserCallback) {
      if (command.UserCallback == ImDrawCallback_ResetRenderState) {
        set_state();
      } else {
        command.UserCallback(&list, &command);
      }
      continue;
    }
    const int left = std::max(static_cast<int>(command.ClipRect.x), 0);
    const int top = std::max(static_cast<int>(command.ClipRect.y), 0);
    const int right = std::min(static_cast<int>(command.ClipRect.z), width);
    const int bottom = std::min(static_cast<int>(command.ClipRect.w), height);
    if (right <= left || bottom <= top) continue;
    gl.Scissor(left, top, right - left, bottom - top);
    gl.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), kIndexType,
                              reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)),
                              static_cast<GLint>(command.VtxOffset));
  }
}

PanelRenderer::PanelRenderer(gl::Context& context, int width, int height, float scale)
    : impl_(std::make_unique<Impl>(context, width, height, scale)) {}
PanelRenderer::~PanelRenderer() = default;

ImGuiContext* PanelRenderer::imgui() const {
  return impl_->imgui;
}

void PanelRenderer::begin_frame() {
  ImGui::SetCurrentContext(impl_->imgui);
  ImGui::NewFrame();
}

void PanelRenderer::end_frame_and_draw() {
  ImGui::SetCurrentContext(impl_->imgui);
  ImGui::Render();
  impl_->draw(*ImGui::GetDrawData());
}

}  // namespace contactscope::overlay

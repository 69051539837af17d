#pragma once

#define GL_GLEXT_PROTOTYPES  // only for function types: nothing links libGL
#include <GL/glcorearb.h>

#include <functional>

namespace contactscope::gl {

// OpenGL 3.3 functions that render/gl uses, without the prefix "gl".
// clang-format off
#define CONTACTSCOPE_GL_FUNCTIONS(X)                                                            \
  X(ActiveTexture) X(AttachShader) X(BindAttribLocation) X(BindBuffer) X(BindFramebuffer)       \
  X(BindRenderbuffer) X(BindTexture) X(BindVertexArray) X(BlendEquation) X(BlendFuncSeparate)   \
  X(BufferData) X(CheckFramebufferStatus) X(Clear) X(ClearColor) X(CompileShader)               \
  X(CreateProgram) X(CreateShader) X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram)      \
  X(DeleteRenderbuffers) X(DeleteShader) X(DeleteTextures) X(DeleteVertexArrays) X(Disable)     \
  X(DrawElements) X(Enable) X(EnableVertexAttribArray) X(FramebufferRenderbuffer)     \
  X(GenBuffers) X(GenFramebuffers) X(GenRenderbuffers) X(GenTextures) X(GenVertexArrays)        \
  X(GetError) X(GetIntegerv) X(GetProgramInfoLog) X(GetProgramiv) X(GetShaderInfoLog)           \
  X(GetShaderiv) X(GetString) X(GetUniformLocation) X(LinkProgram) X(PixelStorei) X(ReadPixels) \
  X(RenderbufferStorage) X(ShaderSource) X(TexImage2D) X(TexParameteri) X(TexSubImage2D)        \
  X(Uniform2f) X(UseProgram) X(VertexAttribPointer) X(Viewport)
// clang-format on

/// OpenGL functions from the route of the current context.
struct Functions {
#define CONTACTSCOPE_DECLARE(name) decltype(&::gl##name) name = nullptr;
  CONTACTSCOPE_GL_FUNCTIONS(CONTACTSCOPE_DECLARE)
#undef CONTACTSCOPE_DECLARE
};

/// Looks up a function by name ("glClear").
using ProcAddress = std::function<void*(const char*)>;

}  // namespace contactscope::gl

#pragma once

#include <GL/glcorearb.h>

#include <functional>

namespace contactscope::gl {

// Every OpenGL 3.3 function that render/gl calls: name without "gl", and its type
// in GL/glcorearb.h.
#define CONTACTSCOPE_GL_FUNCTIONS(X)                           \
  X(ActiveTexture, PFNGLACTIVETEXTUREPROC)                     \
  X(AttachShader, PFNGLATTACHSHADERPROC)                       \
  X(BindAttribLocation, PFNGLBINDATTRIBLOCATIONPROC)           \
  X(BindBuffer, PFNGLBINDBUFFERPROC)                           \
  X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                 \
  X(BindRenderbuffer, PFNGLBINDRENDERBUFFERPROC)               \
  X(BindTexture, PFNGLBINDTEXTUREPROC)                         \
  X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)                 \
  X(BlendEquation, PFNGLBLENDEQUATIONPROC)                     \
  X(BlendFuncSeparate, PFNGLBLENDFUNCSEPARATEPROC)             \
  X(BufferData, PFNGLBUFFERDATAPROC)                           \
  X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC)   \
  X(Clear, PFNGLCLEARPROC)                                     \
  X(ClearColor, PFNGLCLEARCOLORPROC)                           \
  X(CompileShader, PFNGLCOMPILESHADERPROC)                     \
  X(CreateProgram, PFNGLCREATEPROGRAMPROC)                     \
  X(CreateShader, PFNGLCREATESHADERPROC)                       \
  X(DeleteBuffers, PFNGLDELETEBUFFERSPROC)                     \
  X(DeleteFramebuffers, PFNGLDELETEFRAMEBUFFERSPROC)           \
  X(DeleteProgram, PFNGLDELETEPROGRAMPROC)                     \
  X(DeleteRenderbuffers, PFNGLDELETERENDERBUFFERSPROC)         \
  X(DeleteShader, PFNGLDELETESHADERPROC)                       \
  X(DeleteTextures, PFNGLDELETETEXTURESPROC)                   \
  X(DeleteVertexArrays, PFNGLDELETEVERTEXARRAYSPROC)           \
  X(Disable, PFNGLDISABLEPROC)                                 \
  X(DrawElements, PFNGLDRAWELEMENTSPROC)                       \
  X(Enable, PFNGLENABLEPROC)                                   \
  X(EnableVertexAttribArray, PFNGLENABLEVERTEXATTRIBARRAYPROC) \
  X(Finish, PFNGLFINISHPROC)                                   \
  X(FramebufferRenderbuffer, PFNGLFRAMEBUFFERRENDERBUFFERPROC) \
  X(GenBuffers, PFNGLGENBUFFERSPROC)                           \
  X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                 \
  X(GenRenderbuffers, PFNGLGENRENDERBUFFERSPROC)               \
  X(GenTextures, PFNGLGENTEXTURESPROC)                         \
  X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)                 \
  X(GetError, PFNGLGETERRORPROC)                               \
  X(GetIntegerv, PFNGLGETINTEGERVPROC)                         \
  X(GetProgramInfoLog, PFNGLGETPROGRAMINFOLOGPROC)             \
  X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                       \
  X(GetShaderInfoLog, PFNGLGETSHADERINFOLOGPROC)               \
  X(GetShaderiv, PFNGLGETSHADERIVPROC)                         \
  X(GetString, PFNGLGETSTRINGPROC)                             \
  X(GetUniformLocation, PFNGLGETUNIFORMLOCATIONPROC)           \
  X(LinkProgram, PFNGLLINKPROGRAMPROC)                         \
  X(PixelStorei, PFNGLPIXELSTOREIPROC)                         \
  X(ReadPixels, PFNGLREADPIXELSPROC)                           \
  X(RenderbufferStorage, PFNGLRENDERBUFFERSTORAGEPROC)         \
  X(ShaderSource, PFNGLSHADERSOURCEPROC)                       \
  X(TexImage2D, PFNGLTEXIMAGE2DPROC)                           \
  X(TexParameteri, PFNGLTEXPARAMETERIPROC)                     \
  X(TexSubImage2D, PFNGLTEXSUBIMAGE2DPROC)                     \
  X(Uniform2f, PFNGLUNIFORM2FPROC)                             \
  X(UseProgram, PFNGLUSEPROGRAMPROC)                           \
  X(VertexAttribPointer, PFNGLVERTEXATTRIBPOINTERPROC)         \
  X(Viewport, PFNGLVIEWPORTPROC)

/// OpenGL's functions as the current context's route gave them. Nothing links libGL.
struct Functions {
#define CONTACTSCOPE_DECLARE(name, type) type name = nullptr;
  CONTACTSCOPE_GL_FUNCTIONS(CONTACTSCOPE_DECLARE)
#undef CONTACTSCOPE_DECLARE
};

/// Asks `get_proc_address` for each function ("glClear"). Throws ContextError with the name of the
/// first that is missing. A context must be current.
Functions load_functions(const std::function<void*(const char*)>& get_proc_address);

}  // namespace contactscope::gl

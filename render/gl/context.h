#pragma once

#define GL_GLEXT_PROTOTYPES  // only for function types: nothing links libGL
#include <GL/glcorearb.h>

#include "core/standard.h"

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

enum class Backend { Auto, Egl, Osmesa };

/// No backend gave a context. what() lists each one tried with its error and a remedy.
class ContextError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Result of probing a backend, for `doctor` and the message of ContextError.
struct RouteReport {
  std::string route;  // "EGL surfaceless", "EGL device 0", "OSMesa"
  bool works = false;
  std::string version;   // GL_VERSION when it works
  std::string renderer;  // GL_RENDERER
  std::string failure;   // error and remedy
};

/// Library names for dlopen().
struct Libraries {
  std::string egl = "libEGL.so.1";
  std::string osmesa = "libOSMesa.so.8";
};

/// An OpenGL 3.3 core context without a display, current on the thread that created it. Its library
/// is opened at run time and never closed, because drivers leave threads in it.
///
/// A thread has one current context. make_current() first releases another one of the thread,
/// because two routes share Mesa's dispatch table and interfere otherwise; it is free if the
/// context is already current. Destroy a context on its current thread or after release().
class Context {
 public:
  virtual ~Context() = default;

  const Functions& functions() const { return functions_; }
  const std::string& route() const { return route_; }
  void make_current();
  void release();

 protected:
  explicit Context(std::string route) : route_(std::move(route)) {}

  /// Calls of the route. bind() throws ContextError.
  virtual void bind() = 0;
  virtual void unbind() = 0;

 private:
  friend std::unique_ptr<Context> started(std::unique_ptr<Context> context,
                                          const ProcAddress& get_proc_address);

  std::string route_;
  Functions functions_;
};

/// Opens a context and makes it current. Auto tries EGL (surfaceless, then each device), then
/// OSMesa. Throws ContextError and leaves no context current on this thread.
std::unique_ptr<Context> open_context(Backend backend, const Libraries& libraries = {});

/// Tries each route: it works if a cleared pixel can be read back. Leaves no context current on
/// this thread.
std::vector<RouteReport> probe_routes(const Libraries& libraries = {});

}  // namespace contactscope::gl

#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "gl/functions.h"

namespace contactscope::gl {

enum class Backend { Auto, Egl, Osmesa };

/// No route gave a context. what() lists each route tried, why it failed, and what to do.
class ContextError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What one route to OpenGL answers, for `doctor` and for the message of ContextError.
struct RouteReport {
  std::string route;  // "EGL surfaceless", "EGL device 0", "OSMesa"
  bool works = false;
  std::string version;   // GL_VERSION when it works
  std::string renderer;  // GL_RENDERER
  std::string failure;   // why not, and the remedy
};

/// The shared objects that are opened at run time, as dlopen() takes them.
struct Libraries {
  std::string egl = "libEGL.so.1";
  std::string osmesa = "libOSMesa.so.8";
};

/// An OpenGL 3.3 core context without a display, current on the thread that made it. The library is
/// opened at run time; it is closed no earlier than the process ends, for drivers leave threads in
/// it.
///
/// A thread has one current context. make_current() first releases the thread's other one, for
/// two routes share Mesa's dispatch table and mix up otherwise; it costs nothing where the context
/// is current already. Destroy a context on the thread where it is current, or after release().
class Context {
 public:
  virtual ~Context() = default;

  const Functions& functions() const { return functions_; }
  const std::string& route() const { return route_; }
  /// "4.5 (Core Profile) Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string driver() const;
  void make_current();
  void release();

 protected:
  explicit Context(std::string route) : route_(std::move(route)) {}

  /// The route's own calls. bind() throws ContextError.
  virtual void bind() = 0;
  virtual void unbind() = 0;

 private:
  friend std::unique_ptr<Context> started(std::unique_ptr<Context> context,
                                          const ProcAddress& get_proc_address);

  std::string route_;
  Functions functions_;
};

/// Opens a context and makes it current. Auto tries EGL (surfaceless, then each device), then
/// OSMesa. Throws ContextError; then no context is current on this thread.
std::unique_ptr<Context> open_context(Backend backend, const Libraries& libraries = {});

/// Tries every route, one after the other: a route works when a cleared pixel reads back. Leaves no
/// context current on this thread.
std::vector<RouteReport> probe_routes(const Libraries& libraries = {});

}  // namespace contactscope::gl

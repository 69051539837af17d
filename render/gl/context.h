#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace contactscope::gl {

struct Functions;

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

/// An OpenGL 3.3 core context without a display, current on the thread that made it. The library is
/// opened at run time; it is closed no earlier than the process ends, for drivers leave threads in it.
class Context {
 public:
  virtual ~Context() = default;
  virtual const Functions& functions() const = 0;
  virtual const std::string& route() const = 0;
  virtual void make_current() = 0;
  virtual void release() = 0;
};

/// Opens a context and makes it current. Auto tries EGL (surfaceless, then each device), then
/// OSMesa. Throws ContextError.
std::unique_ptr<Context> open_context(Backend backend);

/// Tries every route, one after the other.
std::vector<RouteReport> probe_routes();

}  // namespace contactscope::gl

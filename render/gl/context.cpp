#include "gl/context.h"

#include <dlfcn.h>

#include <array>
#include <cstdint>

#include "gl/routes.h"

namespace contactscope::gl {
namespace {

thread_local Context* current = nullptr;

void release_current() {
  if (current) current->release();
}

/// Tries routes in order and remembers why each failed.
class Search {
 public:
  std::unique_ptr<Context> try_route(const Route& route) {
    try {
      return route.open();
    } catch (const ContextError& error) {
      failures_ += "\n  " + route.name + ": " + error.what();
      return nullptr;
    }
  }
  const std::string& failures() const { return failures_; }

 private:
  std::string failures_;
};

/// Clears one pixel off screen and reads it: a context can open and still draw nothing, as OSMesa
/// does in a process that linked libGL first.
bool draws(const Functions& gl) {
  GLuint framebuffer = 0, renderbuffer = 0;
  gl.GenFramebuffers(1, &framebuffer);
  gl.GenRenderbuffers(1, &renderbuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffer);
  gl.Viewport(0, 0, 1, 1);
  gl.ClearColor(1, 0, 1, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  std::array<std::uint8_t, 4> pixel{};
  gl.ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.DeleteRenderbuffers(1, &renderbuffer);
  return pixel == std::array<std::uint8_t, 4>{255, 0, 255, 255};
}

std::string get_string(const Functions& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text ? reinterpret_cast<const char*>(text) : "";
}

RouteReport probe(const Route& route) {
  RouteReport report;
  report.route = route.name;
  try {
    const std::unique_ptr<Context> context = route.open();
    const Functions& gl = context->functions();
    report.version = get_string(gl, GL_VERSION);
    report.renderer = get_string(gl, GL_RENDERER);
    report.works = draws(gl);
    if (!report.works) report.failure = "a context opens, but a cleared pixel does not read back";
  } catch (const ContextError& error) {
    report.failure = error.what();
  }
  return report;
}

}  // namespace

void RouteContext::make_current() {
  if (current == this) return;
  release_current();
  bind();
  current = this;
}

void RouteContext::release() {
  if (current != this) return;
  current = nullptr;
  unbind();
}

void* open_library(const std::string& name, const std::string& remedy) {
  // RTLD_LOCAL keeps one route's symbols from standing in for the other's.
  void* library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) throw ContextError(std::string(dlerror()) + "; " + remedy);
  return library;
}

void* find_symbol(void* library, const std::string& library_name, const char* symbol) {
  void* address = dlsym(library, symbol);
  if (!address) throw ContextError(library_name + " has no " + symbol);
  return address;
}

std::unique_ptr<Context> open_context(Backend backend, const Libraries& libraries) {
  release_current();
  Search search;
  std::unique_ptr<Context> context;
  if (backend != Backend::Osmesa) {
    context = search.try_route(egl_surfaceless_route(libraries.egl));
    if (context) return context;
    for (const Route& route : egl_device_routes(libraries.egl)) {
      context = search.try_route(route);
      if (context) return context;
    }
  }
  if (backend != Backend::Egl) {
    context = search.try_route(osmesa_route(libraries.osmesa));
    if (context) return context;
  }
  throw ContextError("no OpenGL 3.3 context without a display; tried" + search.failures());
}

std::vector<RouteReport> probe_routes(const Libraries& libraries) {
  release_current();
  std::vector<RouteReport> reports{probe(egl_surfaceless_route(libraries.egl))};
  for (const Route& route : egl_device_routes(libraries.egl)) reports.push_back(probe(route));
  reports.push_back(probe(osmesa_route(libraries.osmesa)));
  return reports;
}

}  // namespace contactscope::gl

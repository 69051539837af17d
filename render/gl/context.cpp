#include "gl/context.h"

#include <dlfcn.h>

#include "gl/routes.h"

namespace contactscope::gl {
namespace {

thread_local Context* current = nullptr;

void release_current() {
  if (current) current->release();
}

/// Clears one pixel off screen and reads it back. A context may open and still draw nothing, like
/// OSMesa in a process that linked libGL first.
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

void Context::make_current() {
  if (current == this) return;
  release_current();
  bind();
  current = this;
}

void Context::release() {
  if (current != this) return;
  current = nullptr;
  unbind();
}

std::unique_ptr<Context> started(std::unique_ptr<Context> context,
                                 const ProcAddress& get_proc_address) {
  context->make_current();
  const auto load = [&](auto& function, const char* name) {
    function =
        reinterpret_cast<std::remove_reference_t<decltype(function)>>(get_proc_address(name));
    if (!function) throw ContextError(std::string("the driver has no ") + name);
  };
#define CONTACTSCOPE_LOAD(name) load(context->functions_.name, "gl" #name);
  CONTACTSCOPE_GL_FUNCTIONS(CONTACTSCOPE_LOAD)
#undef CONTACTSCOPE_LOAD
  return context;
}

Library::Library(const std::string& library_name, const std::string& remedy)
    // RTLD_LOCAL: symbols of one route must not replace those of another.
    : name(library_name), handle(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (!handle) throw ContextError(std::string(dlerror()) + "; " + remedy);
}

Symbol Library::find(const char* symbol) const {
  void* address = dlsym(handle, symbol);
  if (!address) throw ContextError(name + " has no " + symbol);
  return {address};
}

std::unique_ptr<Context> open_context(Backend backend, const Libraries& libraries) {
  release_current();
  std::string failures;
  const auto opened = [&](const Route& route) -> std::unique_ptr<Context> {
    try {
      return route.open();
    } catch (const ContextError& error) {
      failures += "\n  " + route.name + ": " + error.what();
      return nullptr;
    }
  };
  if (backend != Backend::Osmesa) {
    if (auto context = opened(egl_surfaceless_route(libraries.egl))) return context;
    for (const Route& route : egl_device_routes(libraries.egl))
      if (auto context = opened(route)) return context;
  }
  if (backend != Backend::Egl)
    if (auto context = opened(osmesa_route(libraries.osmesa))) return context;
  throw ContextError("no OpenGL 3.3 context without a display; tried" + failures);
}

std::vector<RouteReport> probe_routes(const Libraries& libraries) {
  release_current();
  std::vector<RouteReport> reports{probe(egl_surfaceless_route(libraries.egl))};
  for (const Route& route : egl_device_routes(libraries.egl)) reports.push_back(probe(route));
  reports.push_back(probe(osmesa_route(libraries.osmesa)));
  return reports;
}

}  // namespace contactscope::gl

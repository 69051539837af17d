// EGL without a window system: Mesa's surfaceless platform, and EGL devices.
#define EGL_EGL_PROTOTYPES 0  // all functions are from the opened library
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "gl/routes.h"

namespace contactscope::gl {
namespace {

constexpr const char* kInstall = "install libegl1, libegl-mesa0 and libgl1-mesa-dri";

struct Egl {
  explicit Egl(const std::string& name) : library(name, kInstall) {}

  bool has_extension(EGLDisplay display, std::string_view wanted) const {
    const char* list = query_string(display, EGL_EXTENSIONS);
    std::istringstream words(list ? list : "");
    for (std::string word; words >> word;)
      if (word == wanted) return true;
    return false;
  }
  /// Null if EGL does not have the function.
  Symbol extension(const char* name) const {
    return {reinterpret_cast<void*>(get_proc_address(name))};
  }

  Library library;
  PFNEGLGETPROCADDRESSPROC get_proc_address = library.find("eglGetProcAddress");
  PFNEGLQUERYSTRINGPROC query_string = library.find("eglQueryString");
  PFNEGLINITIALIZEPROC initialize = library.find("eglInitialize");
  PFNEGLBINDAPIPROC bind_api = library.find("eglBindAPI");
  PFNEGLCREATECONTEXTPROC create_context = library.find("eglCreateContext");
  PFNEGLDESTROYCONTEXTPROC destroy_context = library.find("eglDestroyContext");
  PFNEGLMAKECURRENTPROC make_current = library.find("eglMakeCurrent");
  PFNEGLGETERRORPROC get_error = library.find("eglGetError");
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = extension("eglGetPlatformDisplayEXT");
  PFNEGLQUERYDEVICESEXTPROC query_devices = extension("eglQueryDevicesEXT");
};

[[noreturn]] void fail(const Egl& egl, const std::string& call) {
  std::ostringstream text;
  text << call << " failed with 0x" << std::hex << egl.get_error();
  throw ContextError(text.str());
}

class EglContext final : public Context {
 public:
  EglContext(std::string route, const Egl& egl, EGLDisplay display)
      : Context(std::move(route)), egl_(egl), display_(display) {
    if (!egl_.initialize(display_, nullptr, nullptr)) fail(egl_, "eglInitialize");
    for (const char* extension : {"EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"}) {
      if (!egl_.has_extension(display_, extension))
        throw ContextError(std::string("the driver has no ") + extension);
    }
    if (!egl_.bind_api(EGL_OPENGL_API))
      throw ContextError("the driver has no desktop OpenGL, only OpenGL ES");
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             3,
                             EGL_CONTEXT_MINOR_VERSION,
                             3,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_NONE};
    context_ = egl_.create_context(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    if (context_ == EGL_NO_CONTEXT) fail(egl_, "eglCreateContext for OpenGL 3.3 core");
  }
  // The display stays initialized: it is shared by the process, and other contexts may use it.
  ~EglContext() override {
    release();
    egl_.destroy_context(display_, context_);
  }

 private:
  void bind() override {
    if (!egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      fail(egl_, "eglMakeCurrent");
  }
  void unbind() override {
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

  Egl egl_;
  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

std::unique_ptr<Context> open_display(const std::string& route, const Egl& egl, EGLenum platform,
                                      void* native) {
  if (!egl.get_platform_display) throw ContextError("EGL has no eglGetPlatformDisplayEXT");
  EGLDisplay display = egl.get_platform_display(platform, native, nullptr);
  if (display == EGL_NO_DISPLAY) fail(egl, "eglGetPlatformDisplayEXT");
  return started(std::make_unique<EglContext>(route, egl, display), [&](const char* name) {
    return reinterpret_cast<void*>(egl.get_proc_address(name));
  });
}

}  // namespace

Route egl_surfaceless_route(const std::string& library) {
  const std::string name = "EGL surfaceless";
  return {name, [name, library]() -> std::unique_ptr<Context> {
            const Egl egl(library);
            if (!egl.has_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
              throw ContextError(std::string("no EGL driver has EGL_MESA_platform_surfaceless; ") +
                                 kInstall);
            }
            return open_display(name, egl, EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
          }};
}

std::vector<Route> egl_device_routes(const std::string& library) {
  std::vector<Route> routes;
  try {
    const Egl egl(library);
    EGLint count = 0;
    if (!egl.query_devices || !egl.query_devices(0, nullptr, &count) || count <= 0) return routes;
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (!egl.query_devices(count, devices.data(), &count)) return routes;
    for (EGLint i = 0; i < count; ++i) {
      const std::string name = "EGL device " + std::to_string(i);
      const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      routes.push_back({name, [name, egl, device] {
                          return open_display(name, egl, EGL_PLATFORM_DEVICE_EXT, device);
                        }});
    }
  } catch (const ContextError&) {
    // the surfaceless route has reported the error
  }
  return routes;
}

}  // namespace contactscope::gl

// Mesa's off-screen interface: no window system and no EGL. It left Mesa in 25.1.
#include <GL/glcorearb.h>

#include <array>
#include <cstdint>
#include <type_traits>

#include "gl/routes.h"

namespace contactscope::gl {
namespace {

// Constants and types of GL/osmesa.h, which cannot be included: it brings GL/gl.h and its
// prototypes along.
constexpr int kFormat = 0x22, kProfile = 0x33, kCoreProfile = 0x34;
constexpr int kMajorVersion = 0x36, kMinorVersion = 0x37;
using OsmesaHandle = struct osmesa_context*;

struct Osmesa {
  explicit Osmesa(const std::string& name)
      : library(
            open_library(name, "install libosmesa6 where Mesa is older than 25.1, or use EGL")) {
    const auto find = [&](auto& function, const char* symbol) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(
          find_symbol(library, name, symbol));
    };
    find(create_context, "OSMesaCreateContextAttribs");
    find(destroy_context, "OSMesaDestroyContext");
    find(make_current, "OSMesaMakeCurrent");
    find(get_proc_address, "OSMesaGetProcAddress");
  }

  void* library;
  OsmesaHandle (*create_context)(const int* attributes, OsmesaHandle share) = nullptr;
  void (*destroy_context)(OsmesaHandle) = nullptr;
  GLboolean (*make_current)(OsmesaHandle, void* buffer, GLenum type, GLsizei width,
                            GLsizei height) = nullptr;
  void (*(*get_proc_address)(const char* name))() = nullptr;
};

class OsmesaContext final : public RouteContext {
 public:
  OsmesaContext(const std::string& route, const Osmesa& osmesa)
      : RouteContext(route), osmesa_(osmesa) {
    const int wanted[] = {kFormat,       GL_RGBA, kProfile, kCoreProfile, kMajorVersion, 3,
                          kMinorVersion, 3,       0};
    context_ = osmesa_.create_context(wanted, nullptr);
    if (!context_) throw ContextError("OSMesaCreateContextAttribs failed for OpenGL 3.3 core");
    try {
      make_current();
      functions_ = load_functions([this](const char* name) {
        return reinterpret_cast<void*>(osmesa_.get_proc_address(name));
      });
    } catch (...) {
      destroy();
      throw;
    }
  }
  ~OsmesaContext() override { destroy(); }

 private:
  void bind() override {
    if (!osmesa_.make_current(context_, buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide)) {
      throw ContextError("OSMesaMakeCurrent failed");
    }
  }
  void unbind() override { osmesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
  void destroy() {
    release();
    osmesa_.destroy_context(context_);
  }

  // OSMesa insists on a window; pictures go to framebuffer objects.
  static constexpr int kSide = 4;
  Osmesa osmesa_;
  OsmesaHandle context_ = nullptr;
  std::array<std::uint8_t, 4 * kSide * kSide> buffer_{};
};

}  // namespace

Route osmesa_route(const std::string& library) {
  const std::string name = "OSMesa";
  return {name, [name, library]() -> std::unique_ptr<Context> {
            return std::make_unique<OsmesaContext>(name, Osmesa(library));
          }};
}

}  // namespace contactscope::gl

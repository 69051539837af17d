// Mesa's off-screen interface, without a window system or EGL. Mesa 25.1 removed it.

#include "gl/routes.h"

namespace contactscope::gl {
namespace {

// Constants and types of GL/osmesa.h, which cannot be included because it includes GL/gl.h with its
// prototypes.
constexpr int kFormat = 0x22, kProfile = 0x33, kCoreProfile = 0x34;
constexpr int kMajorVersion = 0x36, kMinorVersion = 0x37;
using OsmesaHandle = struct osmesa_context*;

struct Osmesa {
  explicit Osmesa(const std::string& name)
      : library(name, "install libosmesa6 if Mesa is older than 25.1, or use EGL") {}

  Library library;
  OsmesaHandle (*create_context)(const int* attributes,
                                 OsmesaHandle share) = library.find("OSMesaCreateContextAttribs");
  void (*destroy_context)(OsmesaHandle) = library.find("OSMesaDestroyContext");
  GLboolean (*make_current)(OsmesaHandle, void* buffer, GLenum type, GLsizei width,
                            GLsizei height) = library.find("OSMesaMakeCurrent");
  void (*(*get_proc_address)(const char* name))() = library.find("OSMesaGetProcAddress");
};

class OsmesaContext final : public Context {
 public:
  OsmesaContext(const std::string& route, const Osmesa& osmesa) : Context(route), osmesa_(osmesa) {
    const int wanted[] = {kFormat,       GL_RGBA, kProfile, kCoreProfile, kMajorVersion, 3,
                          kMinorVersion, 3,       0};
    context_ = osmesa_.create_context(wanted, nullptr);
    if (!context_) throw ContextError("OSMesaCreateContextAttribs failed for OpenGL 3.3 core");
  }
  ~OsmesaContext() override {
    release();
    osmesa_.destroy_context(context_);
  }

 private:
  void bind() override {
    if (!osmesa_.make_current(context_, buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide))
      throw ContextError("OSMesaMakeCurrent failed");
  }
  void unbind() override { osmesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  // OSMesa requires a window buffer; pictures use framebuffer objects.
  static constexpr int kSide = 4;
  Osmesa osmesa_;
  OsmesaHandle context_ = nullptr;
  std::array<std::uint8_t, 4 * kSide * kSide> buffer_{};
};

}  // namespace

Route osmesa_route(const std::string& library) {
  const std::string name = "OSMesa";
  return {name, [name, library]() -> std::unique_ptr<Context> {
            const Osmesa osmesa(library);
            return started(std::make_unique<OsmesaContext>(name, osmesa), [&](const char* symbol) {
              return reinterpret_cast<void*>(osmesa.get_proc_address(symbol));
            });
          }};
}

}  // namespace contactscope::gl

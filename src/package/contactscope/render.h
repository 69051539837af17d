#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "trace.h"

namespace contactscope::package {

/// sRGB red, green, blue and alpha (always 255), one byte each. Rows from the top, no padding.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba{};  // 4 * width * height
};

/// No OpenGL context: what() lists each backend with its error and a remedy.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct RenderOptions {
  int width = 1280, height = 720;  // pixels, 64 to 8192
  /// Names from `contactscope list layers` and `list panels`; nullopt: the defaults.
  std::optional<std::vector<std::string>> layers{}, panels{};
  std::optional<Vec3> eye{}, target{};  // camera, metres; nullopt: fitted to all frames
  double fov_degrees = 0;               // 1 to 150; 0: the default
  std::string backend = "auto";         // or "egl", "osmesa"
};

/// Draws one frame, 0 <= index < trace.frame_count(). The camera is fitted to all frames, so that
/// pictures of one trace match. Opens OpenGL through EGL or OSMesa without a display on the calling
/// thread, and leaves no context current. Only one thread at a time may draw, because Dear ImGui
/// has one current context.
///
/// Throws RenderError, and std::invalid_argument for an invalid frame, layer or option.
Picture render(const Trace& trace, int index, const RenderOptions& options = {});

/// Draws all frames in order with one OpenGL context, and passes each to `take`.
void render_all(const Trace& trace, const RenderOptions& options,
                const std::function<void(int index, const Picture& picture)>& take);

/// Writes a PNG without alpha; the file is complete or absent. Throws std::invalid_argument if
/// rgba.size() does not match the size, and std::filesystem::filesystem_error.
void write_png(const std::string& path, const Picture& picture);

}  // namespace contactscope::package

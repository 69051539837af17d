#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "trace.h"

namespace contactscope::package {

/// Four bytes a pixel (sRGB red, green, blue, and alpha, which is 255), rows from the top, no padding.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba{};  // 4 * width * height
};

/// No way to OpenGL: what() lists each that was tried, why it failed, and what to do.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct RenderOptions {
  int width = 1280, height = 720;  // pixels, 64 to 8192
  /// As `contactscope list layers` and `list panels` have them; nothing: the usual ones.
  std::optional<std::vector<std::string>> layers{}, panels{};
  std::optional<Vec3> eye{}, target{};  // metres, of the camera; nothing: fitted to all frames
  double fov_degrees = 0;               // 1 to 150; 0: the usual one
  std::string backend = "auto";         // or "egl", "osmesa"
};

/// Draws one frame, 0 <= index < trace.frame_count(). The camera is fitted to all frames, as the program
/// has it, so that pictures of one trace belong together. Opens OpenGL through EGL or OSMesa, without a
/// display, on the calling thread, and leaves none current there; one thread at a time may draw, for Dear ImGui
/// has one current context.
///
/// Throws RenderError, and std::invalid_argument for a frame, layer or option that there is not.
Picture render(const Trace& trace, int index, const RenderOptions& options = {});

/// All frames in order, each handed to `take` as it is drawn, with OpenGL opened once.
void render_all(const Trace& trace, const RenderOptions& options,
                const std::function<void(int index, const Picture& picture)>& take);

/// Writes a PNG, without alpha, that is whole or absent. Throws std::filesystem::filesystem_error, and
/// std::invalid_argument of a picture whose bytes are not as many as its size says.
void write_png(const std::string& path, const Picture& picture);

}  // namespace contactscope::package

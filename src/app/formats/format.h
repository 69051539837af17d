#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/sequence.h"
#include "draw/scene/drawing.h"
#include "draw/staging.h"
#include "image/image.h"
#include "image/picture_origin.h"
#include "trace/trace.h"

/// What `render --format` knows: a row a format in formats.cpp, a file a format beside it.
namespace contactscope::app {

/// One picture on its way into files. A copy shares drawing and pixels.
struct Shot {
  std::shared_ptr<const draw::Drawing> drawing;
  std::shared_ptr<const Image> image{};  // null where no format that was asked for needs pixels
  PictureOrigin origin{};
};

/// What one file of a whole sequence is to be, known before its first picture. The staging and the
/// sequence outlive the file's making.
struct ReelPlan {
  std::string path;
  PictureOrigin origin;  // of all of it: `frames` names them
  const draw::Staging* staging = nullptr;
  const Sequence* sequence = nullptr;
  std::vector<int> frames{};    // their numbers, rising
  std::optional<double> fps{};  // pictures a second; none: as far apart as the frames' times
};

/// One file of a whole sequence, made a picture at a time.
class Reel {
 public:
  Reel() = default;
  virtual ~Reel() = default;
  Reel(const Reel&) = delete;
  Reel& operator=(const Reel&) = delete;

  /// The next picture, and the frame that it shows, which is there during the call alone.
  virtual void add(const Shot& shot, const trace::Frame& frame) = 0;
  /// After the last one: writes the file, which is whole or absent.
  virtual void finish() = 0;
};

/// How pictures become files. `encode`, `begin` or both: with both, a single picture is encoded and
/// several are a reel.
struct Format {
  std::string_view name;
  std::string_view extension;  // ".png"
  std::string_view what;       // in a few words, for people
  bool needs_pixels = false;   // else OpenGL is not opened for it
  /// One picture as the bytes of one file. Called on several threads at once.
  std::vector<std::uint8_t> (*encode)(const Shot& shot) = nullptr;
  /// Begins one file of a whole sequence.
  std::unique_ptr<Reel> (*begin)(const ReelPlan& plan) = nullptr;
  /// Throws UsageError, with the remedy, where what it needs is not on this machine. Called before
  /// anything is rendered.
  void (*require)() = nullptr;
};

/// In the order in which to list them; the first is the default.
const std::vector<Format>& formats();

/// Those of the table that are named, each once, in their order there. Throws UsageError for a name that
/// is not there, which it answers with those that are.
std::vector<const Format*> formats_named(const std::vector<std::string>& names);

}  // namespace contactscope::app

#pragma once

#include "app/cli/sequence.h"
#include "draw/staging.h"
#include "image/png.h"
#include "lint/linter.h"

/// Formats of `render --format`: the rows of formats.cpp.
namespace contactscope::app {

/// A picture to be encoded. Copies share drawing and pixels.
struct Shot {
  std::shared_ptr<const draw::Drawing> drawing;
  std::shared_ptr<const Image> image{};  // null if no requested format needs pixels
  PictureOrigin origin{};
};

/// Description of a file of a whole sequence, before its first picture. Staging and sequence
/// outlive it.
struct ReelPlan {
  std::string path;
  PictureOrigin origin;  // of the whole file: `frames` lists them
  const draw::Staging* staging = nullptr;
  const Sequence* sequence = nullptr;
  std::vector<int> frames{};    // frame numbers, increasing
  std::optional<double> fps{};  // pictures per second; nullopt: by frame times
  // How pages judge contacts, and the findings that they leave out.
  lint::LintOptions to_lint{};
  std::function<bool(lint::Finding&)> is_known{};
};

/// A file of a whole sequence, written picture by picture.
class Reel {
 public:
  virtual ~Reel() = default;

  /// Adds the next picture; `frame` is valid only during the call.
  virtual void add(const Shot& shot, const trace::Frame& frame) = 0;
  /// Writes the file, which is complete or absent.
  virtual void finish() = 0;
};

/// A file format. It has `encode`, `begin` or both: `encode` for a single picture, `begin` for
/// several.
struct Format {
  std::string_view name;
  std::string_view extension;  // ".png"
  std::string_view what;       // short description
  bool needs_pixels = false;   // false: OpenGL is not opened for it
  bool needs_drawings = true;  // false: it is made from the facts, with every stage recorded
  /// Encodes one picture as a file. Must be thread-safe.
  std::vector<std::uint8_t> (*encode)(const Shot& shot) = nullptr;
  /// Begins a file of a whole sequence.
  std::unique_ptr<Reel> (*begin)(const ReelPlan& plan) = nullptr;
  /// Throws UsageError or vector::MissingLibrary, with a remedy, if a dependency is missing. Called
  /// before rendering.
  void (*require)() = nullptr;
};

/// In listing order; the first is the default.
const std::vector<Format>& formats();

/// Named formats, each once, in table order. Throws UsageError for an unknown name; the message
/// lists the known ones.
std::vector<const Format*> formats_named(const std::vector<std::string>& names);

}  // namespace contactscope::app

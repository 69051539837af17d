#pragma once

#include "app/render/formats/format.h"
#include "app/render/renderer.h"

namespace contactscope::app {

/// Destination of a sequence's pictures.
struct Series {
  std::string scenario;             // "hull/face_contact"
  std::optional<std::string> view;  // its folder, if the scenario has several
  PictureOrigin origin{};           // without frame and format, which complete its command
  const draw::Staging* staging = nullptr;
  const Sequence* sequence = nullptr;
  std::vector<int> frames{};
};

/// Writes drawings in all requested formats. Pixels are painted once for all formats, and only if
/// one needs them.
class Sinks {
 public:
  Sinks(std::vector<const Format*> formats, const Options& options, Renderer& renderer);

  /// Opens the files of a sequence. Fails here on a machine without OpenGL.
  void begin(const Series& series);
  void add(const trace::Frame& frame, draw::Drawing drawing);
  /// Ends a sequence after its last picture.
  void end();

  /// A picture of several frames: OUT/`stem`.EXTENSION in each format.
  void add_alone(const std::string& stem, const std::string& scenario, const PictureOrigin& origin,
                 draw::Drawing drawing);

  /// Waits until all is written. Throws the first error.
  void finish() { encoders_.finish(); }

  const EncoderPool& encoders() const { return encoders_; }
  /// By scenario, in order of begin().
  const std::vector<std::pair<std::string, std::vector<std::string>>>& written() const {
    return written_;
  }
  int files() const;
  /// False if add() may get empty drawings.
  bool needs_drawings() const;
  /// Whether a format shows every stage.
  bool needs_stages() const;

 private:
  Shot shot_of(draw::Drawing drawing);
  void encode(const Format& format, const std::string& path, const Shot& shot);
  std::string path_of(const std::string& scenario, const std::filesystem::path& stem,
                      std::string_view extension);

  std::vector<const Format*> formats_;
  const Options& options_;
  Renderer& renderer_;
  bool needs_pixels_;
  Series series_;
  std::vector<std::unique_ptr<Reel>> reels_;
  EncoderPool encoders_;
  std::vector<std::pair<std::string, std::vector<std::string>>> written_;
};

}  // namespace contactscope::app

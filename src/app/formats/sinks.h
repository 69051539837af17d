#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/formats/format.h"
#include "app/studio.h"

namespace contactscope::app {

/// Where a sequence's pictures go.
struct Series {
  std::string scenario;             // "hull/face_contact"
  std::optional<std::string> view;  // its folder, where the scenario has several
  PictureOrigin origin{};           // without frame and format, which its command ends in
  const draw::Staging* staging = nullptr;
  const Sequence* sequence = nullptr;
  std::vector<int> frames{};
};

/// Turns drawings into the files of all formats that were asked for. Pixels are painted once for all of
/// them, and OpenGL is opened where one needs some.
class Sinks {
 public:
  Sinks(std::vector<const Format*> formats, const Options& options, Studio& studio);

  /// Opens the files of a sequence. A machine without OpenGL says so here.
  void begin(const Series& series);
  void add(const trace::Frame& frame, draw::Drawing drawing);
  /// After the last picture of the sequence.
  void end();

  /// A picture that is of no single frame: OUT/`stem`.EXTENSION in each format.
  void add_alone(const std::string& stem, const std::string& scenario, const PictureOrigin& origin,
                 draw::Drawing drawing);

  /// Waits until all is written. Throws the first error.
  void finish() { encoders_.finish(); }

  const EncoderPool& encoders() const { return encoders_; }
  /// By scenario, in the order in which they were begun.
  const std::vector<std::pair<std::string, std::vector<std::string>>>& written() const {
    return written_;
  }
  int files() const;

 private:
  Shot shot_of(draw::Drawing drawing);
  void encode(const Format& format, const std::string& path, const Shot& shot);
  std::string path_of(const std::string& scenario, const std::filesystem::path& stem,
                      std::string_view extension);

  std::vector<const Format*> formats_;
  const Options& options_;
  Studio& studio_;
  bool needs_pixels_;
  Series series_;
  std::vector<std::unique_ptr<Reel>> reels_;
  EncoderPool encoders_;
  std::vector<std::pair<std::string, std::vector<std::string>>> written_;
};

}  // namespace contactscope::app

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/layers.h"
#include "gl/context.h"

namespace contactscope::app {

/// "A:B[:STEP]", B inclusive; "A" alone is one frame.
struct FrameRange {
  int first = 0;
  int last = 0;
  int step = 1;

  /// The frames of a sequence of `frames` that the range names.
  std::vector<int> select(int frames) const;
  /// Whether it names this one.
  bool names(int frame) const;
};

/// Parses a --frames argument. Throws UsageError.
FrameRange parse_frame_range(const std::string& text);

struct Size {
  int width = 1280;
  int height = 720;
};

/// The default for a picture in which so many reducers or other methods are compared: tall where
/// they are more than nine, so that they can be told apart.
Size roomy_size(std::size_t methods);

/// Parses a --size argument, "WxH". Throws UsageError.
Size parse_size(const std::string& text);

/// Parse the names of a --layers and of a --panels argument: none given is nothing, "none" alone is
/// an empty list. Throw UsageError.
std::optional<std::vector<Layer>> parse_layers(const std::vector<std::string>& names);
std::optional<std::vector<Panel>> parse_panels(const std::vector<std::string>& names);

enum class Update { Never, Failed, All };

/// Parses an --update argument. Throws UsageError.
Update parse_update(const std::string& text);

/// Parses the name of a route to OpenGL; `where` is the option or variable that gave it. Throws
/// UsageError.
gl::Backend parse_backend(const std::string& where, const std::string& text);

/// The command line, parsed.
struct Options {
  std::vector<std::string> scenarios;
  std::string out = "out";
  std::string scenario_root = "scenarios";
  std::string snapshot_root = "snapshots";
  gl::Backend backend = gl::Backend::Auto;
  std::optional<Size> size;
  std::optional<FrameRange> frames;
  std::string view;
  std::string reducer;
  std::optional<std::vector<Layer>> layers;  // of every view, instead of its own
  std::optional<std::vector<Panel>> panels;
  std::string what;  // of `list`
  Update update = Update::Never;
  int jobs = 0;              // 0: as many as there are processors
  std::string study;         // name of the study to run
  std::uint64_t seed = 1;    // of its cases
  std::optional<int> cases;  // a point of a study; the study knows a default
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool timing = false;
  bool tables_only = false;
};

/// The command line is wrong; what() says how and what would be right. Exit code 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class ExitCode { Same = 0, Different = 1, Trouble = 2 };

}  // namespace contactscope::app

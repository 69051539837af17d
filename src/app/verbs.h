#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/figure_options.h"
#include "core/layers.h"
#include "gl/context.h"
#include "snapshot/verdict.h"

namespace contactscope::app {

/// "A:B[:STEP]", B inclusive; "A" alone is one frame.
struct FrameRange {
  int first = 0;
  int last = 0;
  int step = 1;

  /// Whether it names this one.
  bool names(int frame) const {
    return frame >= first && frame <= last && (frame - first) % step == 0;
  }
};

struct Size {
  int width = 1280;
  int height = 720;
};

/// The default for a picture in which so many reducers or other methods are compared: tall where
/// they are more than nine, so that they can be told apart.
inline Size roomy_size(std::size_t methods) {
  return methods > 9 ? Size{1280, 1440} : Size{};
}

/// The command line is wrong; what() says how and what would be right. Exit code 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The command line, parsed.
struct Options {
  std::vector<std::string> scenarios;
  std::string out = "out";
  std::string scenario_root = "scenarios";
  std::string snapshot_root = "snapshots";
  gl::Backend backend = gl::Backend::Auto;
  std::optional<Size> size;
  std::optional<FrameRange> frames;
  std::vector<std::string> formats = {"png"};  // of `render`
  std::optional<double> fps;   // of animations, pictures a second; none: by the frames' times
  std::optional<int> strip;    // so many frames in one picture
  std::optional<int> columns;  // of its cells, or those of a sheet
  bool sheet = false;          // one picture of all scenarios
  bool anchors = false;        // beside each picture, where things are in it
  std::string given;  // what else of the command line pictures depend on, " --size 640x360"
  std::string view;   // a name; of a trace also a TOML file, or file:name
  std::vector<std::string> pair;              // two shapes: nothing else is shown
  std::vector<std::string> shapes;            // those to show; none: all
  std::vector<double> eye, target;            // of the camera, metres; none: the view's
  double fov_degrees = 0;                     // 0: the view's
  std::vector<double> camera;                 // eye, target and, where it is told, field of view
  std::optional<double> orthographic_height;  // metres; 0: fitted; none: the view's projection
  FigureOptions figure;
  std::string reducer;
  std::vector<std::string> engines;          // of `versus`; none: all that are found
  bool rollout = false;                      // they step the scene themselves
  double time_limit = 60;                    // seconds, of an engine's program
  std::optional<std::vector<Layer>> layers;  // of every view, instead of its own
  std::optional<std::vector<Panel>> panels;
  std::string what;  // of `list`
  snapshot::Update update = snapshot::Update::None;
  bool facts_only = false;               // `check` draws nothing
  bool accept = false;                   // it accepts what is named, of its last report
  std::string accept_as;                 // under a word more: "osmesa"
  std::string note;                      // what stands beside that
  bool list_only = false;                // `review` prints what there is
  std::string from;                      // a file of decisions for it
  std::string junit, markdown;           // files to write
  bool github = false;                   // annotations on standard output
  std::string pictures = "auto";         // of `show`: how a terminal draws them
  std::optional<snapshot::Shard> shard;  // which part of all scenarios
  std::string times;                     // a file that says how long each takes
  bool fresh = false;                    // also what nothing changed of is checked
  int jobs = 0;                          // 0: as many as there are processors
  std::string condition;                 // of `shrink`: what has to stay
  std::string study;                     // name of the study to run
  std::uint64_t seed = 1;                // of its cases
  std::optional<int> cases;              // a point of a study; the study knows a default
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool timing = false;
  bool tables_only = false;

  /// Those of a sequence's frames that --frames names; all without it.
  std::vector<int> selected(int frame_count) const {
    std::vector<int> list;
    for (int f = 0; f < frame_count; ++f) {
      if (!frames || frames->names(f)) list.push_back(f);
    }
    return list;
  }
};

enum class ExitCode { Same = 0, Different = 1, Trouble = 2 };

/// A verb of the program. It prints its result on standard output and messages on standard error.
/// InputError, UsageError and gl::ContextError pass through to main.
struct Verb {
  std::string name;
  std::string summary;  // one line
  ExitCode (*run)(const Options& options);
  // In the order of its help, "SCENARIO... [FILE] --size": brackets around what may be left out,
  // dots behind what may be several. main.cpp knows which of the Options each sets.
  std::string arguments;
  // What the verb makes of an argument, where that is not the same for all, which main.cpp knows.
  std::map<std::string, std::string> help{};
  std::string footer{};  // of its help
};

/// Every verb, in the order in which to list them.
const std::vector<Verb>& verbs();

/// What `list` lists.
inline const std::vector<std::string> kListed = {
    "scenarios", "reducers", "broad_phases", "continuous", "layers", "panels", "studies", "words"};

/// The words of its arguments, also those that every verb has.
std::vector<std::string> arguments_of(const Verb& verb);

/// Refuses a verb or an option that there is not, by its name and with the one that may be meant,
/// before a parser counts what follows it among the positional arguments. `arguments`: those after
/// the program's name. Throws UsageError. What a verb does with its arguments is not judged.
void check_usage(const std::vector<std::string>& arguments);

}  // namespace contactscope::app

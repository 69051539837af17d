#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/figure_options.h"
#include "gl/context.h"
#include "snapshot/verdict.h"
#include "view/layers.h"

namespace contactscope::app {

/// "A:B[:STEP]", B inclusive; "A" alone is one frame.
struct FrameRange {
  int first = 0;
  int last = 0;
  int step = 1;

  bool names(int frame) const {
    return frame >= first && frame <= last && (frame - first) % step == 0;
  }
};

struct Size {
  int width = 1280;
  int height = 720;
};

/// Default size of a picture that compares `methods` reducers or other methods: taller for more
/// than nine, to keep them legible.
inline Size roomy_size(std::size_t methods) {
  return methods > 9 ? Size{1280, 1440} : Size{};
}

/// Invalid command line; what() has the problem and the remedy. Exit status 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Options {
  std::vector<std::string> scenarios;
  std::string out = "out";
  std::string scenario_root = "scenarios";
  std::string snapshot_root = "snapshots";
  gl::Backend backend = gl::Backend::Auto;
  std::optional<Size> size;
  std::optional<FrameRange> frames;
  std::vector<std::string> formats = {"png"};  // for `render`
  std::optional<double> fps;        // pictures per second of animations; nullopt: by frame times
  std::optional<int> strip;         // number of frames in one picture
  std::optional<int> columns;       // of a strip or sheet
  bool sheet = false;               // one picture of all scenarios
  bool anchors = false;             // also write the positions of objects in each picture
  std::string given;                // other arguments that pictures depend on, " --size 640x360"
  std::string view;                 // a name; for traces also a TOML file, or file:name
  std::vector<std::string> pair;    // two shapes; hides all others
  std::vector<std::string> shapes;  // shapes to show; empty: all
  std::vector<double> eye, target;  // camera, metres; empty: the view's
  double fov_degrees = 0;           // 0: the view's
  std::vector<double> camera;       // eye, target and optionally field of view
  std::optional<double> orthographic_height;  // metres; 0: fitted; nullopt: the view's projection
  FigureOptions figure;
  std::string reducer;
  std::vector<std::string> engines;          // for `versus`; empty: all that are found
  bool rollout = false;                      // engines step the scene themselves
  double time_limit = 60;                    // seconds, for an engine's program
  std::optional<std::vector<Layer>> layers;  // for every view, instead of its own
  std::optional<std::vector<Panel>> panels;
  std::string what;  // for `list`
  snapshot::Update update = snapshot::Update::None;
  bool facts_only = false;               // `check` draws nothing
  bool accept = false;                   // accept findings of the last report
  std::string accept_as;                 // with an extra word: "osmesa"
  std::string note;                      // text stored with it
  bool list_only = false;                // `review` only prints the list
  std::string from;                      // file of decisions for `review`
  std::string junit, markdown;           // output files
  bool github = false;                   // annotations on standard output
  std::string pictures = "auto";         // for `show`: method of drawing in a terminal
  std::optional<snapshot::Shard> shard;  // part of all scenarios
  std::string times;                     // file with the cost of each scenario
  bool fresh = false;                    // also check scenarios that have not changed
  int jobs = 0;                          // 0: number of processors
  std::string condition;                 // for `shrink`: expression to preserve
  std::string study;                     // name of the study to run
  std::uint64_t seed = 1;                // for its cases
  std::optional<int> cases;              // per point of a study; nullopt: the study's default
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool timing = false;
  bool tables_only = false;

  /// Indices of frames selected by --frames; all without it.
  std::vector<int> selected(int frame_count) const {
    std::vector<int> list;
    for (int f = 0; f < frame_count; ++f) {
      if (!frames || frames->names(f)) list.push_back(f);
    }
    return list;
  }
};

enum class ExitCode { Same = 0, Different = 1, Trouble = 2 };

/// A verb prints results to standard output and messages to standard error. InputError, UsageError
/// and gl::ContextError pass through to main.
struct Verb {
  std::string name;
  std::string summary;  // one line
  ExitCode (*run)(const Options& options);
  // In the order of the help, "SCENARIO... [FILE] --size": brackets for optional arguments, dots
  // for repeatable ones. main.cpp maps them to members of Options.
  std::string arguments;
  // Help of arguments that differs from the common one in main.cpp.
  std::map<std::string, std::string> help{};
  std::string footer{};  // shown after the help
};

/// All verbs, in listing order.
const std::vector<Verb>& verbs();

/// Arguments of `list`.
inline const std::vector<std::string> kListed = {
    "scenarios", "reducers", "broad_phases", "continuous", "layers", "panels", "studies", "words"};

/// Names of its arguments, including common ones.
std::vector<std::string> arguments_of(const Verb& verb);

/// Rejects unknown verbs and options with a suggestion, before the parser takes their values for
/// positional arguments. `arguments` are without the program's name. Throws UsageError. Does not
/// check the arguments of a verb.
void check_usage(const std::vector<std::string>& arguments);

}  // namespace contactscope::app

#pragma once

#include "draw/scene/layout.h"
#include "gl/context.h"
#include "snapshot/verdict.h"

namespace contactscope::app {

/// A length as text: "84mm", "8pt", "992px".
struct FigureLength {
  double value = 0;  // points of 1/72 inch, or pixels
  bool in_pixels = false;

  double pixels(double dpi) const { return in_pixels ? value : value * dpi / 72; }
};

/// Options of figures for talks and papers, shared by all verbs that draw, as read.
struct FigureOptions {
  std::string words;               // a file
  std::vector<std::string> fonts;  // regular, and optionally bold
  double dpi = 300;                // pixels per inch for physical sizes
  double scale = 1, line_width = 1;
  bool bare = false, no_title = false, no_legend = false, no_footer = false;

  std::optional<FigureLength> width{}, height{}, font_size{};
  draw::Theme theme = draw::Theme::Light;
  std::optional<draw::Color> background{};

  draw::FigureStyle style{};  // of all these, without `words`, which also depend on the scenario
};

/// Characters without a glyph in any font, over all drawings of a run.
class MissingGlyphs {
 public:
  void look(const draw::Drawing& drawing);
  /// Prints the characters and a remedy once; nothing if none is missing.
  void report(std::ostream& out) const;

 private:
  std::set<char32_t> missing_;
};

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
inline Size roomy_size(std::size_t methods) { return methods > 9 ? Size{1280, 1440} : Size{}; }

/// Invalid command line; what() has the problem and the remedy. Exit status 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Options of `render`, and of other verbs that draw.
struct PictureOptions : FigureOptions {
  std::optional<Size> size;
  gl::Backend backend = gl::Backend::Auto;
  std::vector<std::string> formats = {"png"};
  std::optional<double> fps;        // pictures per second of animations; nullopt: by frame times
  std::optional<int> strip;         // number of frames in one picture
  std::optional<int> columns;       // of a strip or sheet
  bool sheet = false;               // one picture of all scenarios
  bool anchors = false;             // also write the positions of objects in each picture
  bool timing = false;              // show run times
  std::string given;                // other arguments that pictures depend on, " --size 640x360"
  std::string view;                 // a name; for traces also a TOML file, or file:name
  std::vector<std::string> pair;    // two shapes; hides all others
  std::vector<std::string> shapes;  // shapes to show; empty: all
  std::vector<std::string> focus;   // of the camera: shapes, or one word
  std::vector<double> eye, target;  // camera, metres; empty: the view's
  double fov_degrees = 0;           // 0: the view's
  std::vector<double> camera;       // eye, target and optionally field of view
  std::optional<double> orthographic_height;  // metres; 0: fitted; nullopt: the view's projection
  std::optional<std::vector<Layer>> layers;   // for every view, instead of its own
  std::optional<std::vector<Panel>> panels;
};

/// Options of `check`, and of the verbs for its report.
struct CheckOptions {
  std::string snapshot_root = "snapshots";
  snapshot::Update update = snapshot::Update::None;
  bool write_missing = false;            // store what has no snapshot
  bool facts_only = false;               // draw nothing
  bool accept = false;                   // accept findings of the last report
  std::string accept_as;                 // with an extra word: "osmesa"
  std::string note;                      // text stored with it
  bool list_only = false;                // `review` only prints the list
  std::string from;                      // file of decisions for `review`
  std::string junit, markdown;           // output files
  bool github = false;                   // annotations on standard output
  std::string pictures = "auto";         // for `show`: method of drawing in a terminal
  std::optional<snapshot::Shard> shard;  // part of all scenarios
};

/// Options of `lint`.
struct LintOptions {
  bool strict = false;               // report what is below a threshold
  std::vector<std::string> ignored;  // CAUSE or CAUSE:SHAPE
  double tolerance = 0;              // metres; 0: a share of each shape's size
  std::string known, write_known;    // files of findings
};

/// Options of `explore`, `study`, `versus`, `diff` and `shrink`.
struct CompareOptions {
  std::vector<std::string> engines;  // empty: all that are found
  bool rollout = false;              // engines step the scene themselves
  double time_limit = 60;            // seconds, for an engine's program
  std::string condition;             // for `shrink`: expression to preserve
  std::optional<int> point;          // for `why`: of the pair, from 0
  std::string picture;               // file for `diff`; empty: draw nothing
  std::string study;                 // name of the study to run
  std::uint64_t seed = 1;            // for its cases
  std::optional<int> cases;          // per point of a study; nullopt: the study's default
  bool tables_only = false;          // draw nothing
};

struct Options : PictureOptions, CheckOptions, LintOptions, CompareOptions {
  std::vector<std::string> scenarios;  // or other files, folders or names
  std::string what;                    // argument of `list` and `help`
  std::string document;                // second argument of `list`
  std::string scenario_root = "scenarios";
  std::string out = "out";
  std::optional<FrameRange> frames;
  std::string reducer;          // instead of the scenario's
  std::optional<int> triangle;  // of a mesh: its stages are recorded
  bool rose = false;            // of moments
  int jobs = 0;                 // 0: number of processors
  bool json = false, quiet = false, verbose = false;

  /// Indices of frames selected by --frames; all without it.
  std::vector<int> selected(int frame_count) const {
    std::vector<int> list;
    for (int f = 0; f < frame_count; ++f)
      if (!frames || frames->names(f)) list.push_back(f);
    return list;
  }
};

/// Reads the text of an option, several values with commas between them, into a member of Options.
/// Throws UsageError.
using Reader = void (*)(Options& to, const std::string& option, const std::string& text);

/// Where the value of an option goes.
using Target =
    std::variant<bool Options::*, int Options::*, double Options::*, std::uint64_t Options::*,
                 std::optional<int> Options::*, std::optional<double> Options::*,
                 std::string Options::*, std::vector<std::string> Options::*,
                 std::vector<double> Options::*, Reader>;

/// Values of an option, for shells and range checks.
struct OptionValues {
  enum class Kind { Free, Words, List, Scenario, File, Folder };
  Kind kind = Kind::Free;
  std::vector<std::string> words{};  // for Words, and for List, which separates them by commas
  bool is_closed = false;            // other words are errors of usage
  std::string implied{};             // value of an option that may stand without one
  double min = 0, max = 0;           // of a number; equal: no limit
};

/// An option or argument, as one or several verbs take it. Parsing, help, man page and completions
/// follow from it.
struct Option {
  // "--size"; or an argument, "SCENARIO": in brackets where it is optional, with dots where it
  // repeats.
  std::string usage;
  std::string value;  // placeholder of its value in the help: "WxH"
  std::string verbs;  // "render explore"; empty: all
  Target to;
  std::string help;
  OptionValues values{};
  // Part of the command in the metadata of pictures. Not if pictures do not depend on it, or if
  // each picture adds its own.
  bool is_recorded = true;

  /// "--size", or "SCENARIO".
  std::string name() const;
  bool is_argument() const { return !usage.starts_with("--"); }
  bool is_required() const { return is_argument() && !usage.starts_with('['); }
  /// Whether a value follows the name.
  bool takes_value() const;
  /// An argument that repeats, or an option with a list of values.
  bool repeats() const;
  /// Help, limits and default in one line.
  std::string description() const;
};

/// In the order of the help.
std::vector<const Option*> options_of(const std::string& verb);

/// Arguments of `list`.
inline const std::vector<std::string> kListed = {
    "scenarios", "reducers", "broad_phases", "continuous", "layers",
    "panels",    "studies",  "words",        "sources",    "gregorius",
    "catto",     "survey",   "lecture",      "project",    "course"};
inline const std::vector<std::string> kDocumentNames = {"gregorius", "catto", "survey", "lecture",
                                                        "project"};

/// Uses $CONTACTSCOPE_BACKEND, if it is set. Throws UsageError.
void use_backend_of_environment(Options& options);

/// Checks options that depend on each other, and derives what follows from several. Throws
/// UsageError, FontError.
void finish(Options& options);

// Readers of options whose text is more than a word or a number. Each throws UsageError, with the
// name of the option and a remedy.

/// Position of a word among those of an option. Throws UsageError with the nearest and all of them.
std::size_t word_in(const std::string& option, const std::string& text,
                    const std::vector<std::string_view>& known);

/// Reads all of a text as a number.
template <class Number> std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number)
                                                                  : std::nullopt;
}

Size parse_size(const std::string& option, const std::string& text);
FrameRange parse_frames(const std::string& option, const std::string& text);
/// Metres; 0: fitted.
double parse_orthographic(const std::string& option, const std::string& text);
/// `option` may also be the environment variable that has the text.
gl::Backend parse_backend(const std::string& option, const std::string& text);
snapshot::Update parse_update(const std::string& option, const std::string& text);
snapshot::Shard parse_shard(const std::string& option, const std::string& text);
/// "none" alone is an empty list.
std::vector<Layer> parse_layers(const std::string& option, const std::string& text);
std::vector<Panel> parse_panels(const std::string& option, const std::string& text);
FigureLength parse_length(const std::string& option, const std::string& text);
draw::Color parse_background(const std::string& option, const std::string& text);
draw::Theme parse_theme(const std::string& option, const std::string& text);

/// A reader that parses into a member of Options.
template <auto kMember, auto kParse>
void read(Options& to, const std::string& option, const std::string& text) {
  to.*kMember = kParse(option, text);
}

}  // namespace contactscope::app

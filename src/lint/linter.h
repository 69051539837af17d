#pragma once

#include "trace/json.h"

/// Recomputes every claim of a trace about contacts from its shapes and poses alone. Wrong claims
/// with a common cause are reported once, as the mistake that explains them.
namespace contactscope::lint {

/// An occurrence of a problem, for a timeline.
struct Mark {
  int frame = 0;
  int line = 0;                   // line in the file, from 1; 0: none
  std::string a, b;               // shapes; b may be empty
  std::optional<Vec3d> at{};      // world
  std::optional<Vec3d> normal{};  // that the shapes have there, world; as the record's, A to B
  std::optional<std::array<Vec3d, 2>> path{};  // of the body in a step, world
};

/// Occurrences of a problem in one pair, with the first of them.
struct OfPair {
  std::string a, b;
  int count = 0;
  int line = 0, frame = 0;
  std::string said{}, is{};
  std::optional<Vec3d> at{};  // world
};

/// One problem with all its occurrences.
struct Finding {
  std::string cause;   // "flipped_normals"; for programs
  std::string what;    // "normals of all 37 pairs point from b to a"
  std::string remedy;  // how to fix it
  int count = 0;       // occurrences
  int of = 0;          // out of this many cases of all frames; 0: not counted
  // The first or the worst occurrence:
  int line = 0;  // line in the file, from 1; 0: none
  int frame = 0;
  std::string a{}, b{};         // shapes; b may be empty
  std::string said{}, is{};     // "separation -0.02", "the surfaces are 0.04 m apart"
  std::optional<Vec3d> at{};    // world
  std::vector<Mark> marks{};    // in the order of frames; of many, an evenly spaced subset, unless
                                // LintOptions::is_marked chooses the frames
  std::vector<OfPair> pairs{};  // the first 1,000; empty: not counted by pair
  std::vector<int> frames{};    // in which it occurs; of many, an evenly spaced subset
  /// The threshold that it does not reach: "2 % of them, or 15 tolerances". Empty: it is reported.
  std::string below{};
  bool is_hint = false;    // no fault, but worth knowing
  bool is_severe = false;  // farther off than engines approximate
  double size = 1;         // of the error, relative to the smaller shape; 1: all of it is wrong
  double gross = 0;        // size of a case far beyond approximations; 0: there is none
  std::string_view cases = "pairs";       // "poses", "points"
  std::pair<std::string, double> fits{};  // a shape, or all, and the scale at which contacts fit; 0
};

/// Whether it is a fault, and often or large enough.
inline bool is_reported(const Finding& finding) {
  return finding.below.empty() && !finding.is_hint;
}

/// Names of all causes that findings may have.
std::vector<std::string_view> causes();

/// Findings to leave out.
struct Ignored {
  std::string cause;
  std::string shape{};  // only those about this shape; empty: all
};

struct LintOptions {
  /// Shapes and poses were given to the engine, so do not check them.
  bool shapes_are_given = false;
  /// Ids are made from geometry (trace::name_points), so do not check them.
  bool ids_are_made = false;
  /// Reports every occurrence: no finding is below a threshold.
  bool strict = false;
  /// Allowed error of separations and positions, metres; 0: a share of the smaller shape.
  double tolerance = 0;
  std::vector<Ignored> ignored{};
  /// Whether every occurrence in a frame is marked, or none. Empty: a sample of all frames is.
  std::function<bool(int frame)> is_marked{};

  bool ignores(const std::string& cause, const std::string& a, const std::string& b) const;
};

/// Checks a trace frame by frame. Keeps sums and some examples of earlier frames, so memory does
/// not depend on the number of frames.
class Linter {
 public:
  explicit Linter(const trace::Header& header, const LintOptions& options = {});
  ~Linter();

  /// Call in order.
  void frame(trace::Frame frame);
  /// Adds the shapes of a skipped frame.
  void shapes(const std::vector<trace::Shape>& added);
  /// Like frame(), for a frame that stays in memory until two more were seen.
  void look_at(const trace::Frame& frame);

  /// After the last frame: mistakes, their effects, and claims that nothing explains, the latter
  /// two by their share of the cases and their size; then those below a threshold, and hints.
  std::vector<Finding> findings();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Checks a complete trace. Without hints and findings below a threshold.
std::vector<Finding> lint(const trace::Trace& trace, const LintOptions& options = {});

}  // namespace contactscope::lint

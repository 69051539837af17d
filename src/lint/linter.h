#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trace/json.h"

/// Recomputes every claim of a trace about contacts from its shapes and poses alone. Wrong claims
/// with a common cause are reported once, as the mistake that explains them.
namespace contactscope::lint {

/// One problem with all its occurrences.
struct Finding {
  std::string cause;   // "flipped_normals"; for programs
  std::string what;    // "normals of all 37 pairs point from b to a"
  std::string remedy;  // how to fix it
  int count = 0;       // occurrences
  int of = 0;          // out of this many; 0: not counted
  // The first or the worst occurrence:
  int line = 0;  // line in the file, from 1; 0: none
  int frame = 0;
  std::string a{}, b{};      // shapes; b may be empty
  std::string said{}, is{};  // "separation -0.02", "the surfaces are 0.04 m apart"
};

struct LintOptions {
  /// Shapes and poses were given to the engine, so do not check them.
  bool shapes_are_given = false;
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

  /// After the last frame: all problems, the most frequent causes first.
  std::vector<Finding> findings();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Checks a complete trace.
std::vector<Finding> lint(const trace::Trace& trace, const LintOptions& options = {});

}  // namespace contactscope::lint

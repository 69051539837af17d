#pragma once

#include <memory>
#include <string>
#include <vector>

#include "trace/json.h"

/// Every claim of a trace about contacts, worked out again from its shapes and poses alone; what many wrong
/// claims have in common is told once, as the mistake that they would be right under.
namespace contactscope::lint {

/// Something that is wrong, wherever it is.
struct Finding {
  std::string cause;   // "flipped_normals"; for programs
  std::string what;    // "normals of all 37 pairs point from b to a"
  std::string remedy;  // what to do about it
  int count = 0;       // how often
  int of = 0;          // of how many; 0: not counted
  // The first, or the worst, of them:
  int line = 0;  // of the file, from 1; 0: of no line
  int frame = 0;
  std::string a{}, b{};      // shapes; b may be empty
  std::string said{}, is{};  // "separation -0.02", "the surfaces are 0.04 m apart"
};

struct LintOptions {
  /// Shapes and poses are as they were asked for, so that no mistake of theirs is looked for.
  bool shapes_are_given = false;
};

/// Goes through a trace frame by frame; of those before it keeps sums and some examples, so that memory does not
/// depend on how many there are.
class Linter {
 public:
  explicit Linter(const trace::Header& header, const LintOptions& options = {});
  ~Linter();

  /// The frames in their order.
  void frame(trace::Frame frame);
  /// Shapes of a frame that is passed over.
  void shapes(const std::vector<trace::Shape>& added);
  /// The same of a frame that stays where it is until two more were seen.
  void look_at(const trace::Frame& frame);

  /// After the last frame: what is wrong, the most frequent causes first.
  std::vector<Finding> findings();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The whole of a trace that was read.
std::vector<Finding> lint(const trace::Trace& trace, const LintOptions& options = {});

}  // namespace contactscope::lint

#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "shrink/expression.h"
#include "shrink/pair_of_two.h"
#include "trace/json.h"

namespace contactscope::shrink {

/// An engine that is asked for contacts: the trace that it answers with.
using Engine = std::function<trace::Trace(const trace::Trace& request)>;

/// Says of a pair whether what is looked for still holds. A pair is judged by the scenario that would be
/// written of it, so that what holds here holds for the file.
class Judge {
 public:
  /// `engines`: one for each side of the expression that is none of its own: "", "float", "double", "recorded",
  /// "lint", "unmet".
  explicit Judge(const Expression& expression, std::map<std::string, Engine> engines = {})
      : expression_(expression), engines_(std::move(engines)) {}

  /// False also of what is no scenario: a hull without a volume, a shape too large.
  bool holds(const PairOfTwo& pair);
  /// From here on `unmet` is what the expectations of this pair are not met by, and nothing else: a pair that
  /// was expected to have four points and has two does not become one that has none.
  void remember_unmet(const PairOfTwo& pair);
  int requested() const { return queries_; }

  /// What the pipeline in double says: what is expected where nobody wrote it. Empty where it is no scenario.
  static std::optional<trace::Pair> in_double(const PairOfTwo& pair);
  /// The pair as a trace of one frame, with its claims where it has any.
  static trace::Trace trace_of(const PairOfTwo& pair);

 private:
  const Expression& expression_;
  std::map<std::string, Engine> engines_;
  std::unordered_map<std::string, bool> known_;
  std::optional<std::vector<std::string>> unmet_;
  std::optional<std::size_t> warnings_;  // of the first pair for which it held
  int queries_ = 0;
};

}  // namespace contactscope::shrink

#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "find/expression.h"
#include "shrink/pair_of_two.h"
#include "trace/json.h"

namespace contactscope::shrink {

/// An engine to query for contacts: returns its trace.
using Engine = std::function<trace::Trace(const trace::Trace& request)>;

/// The names that a condition of `shrink` may use.
const find::Vocabulary& vocabulary();

/// Tests whether a pair still has the property. Runs the scenario that would be written for the
/// pair, so the result also holds for the file.
class Judge {
 public:
  /// `engines`: one for each side of the expression that is not built in: "", "float", "double",
  /// "recorded", "lint", "unmet".
  explicit Judge(const find::Expression& expression, std::map<std::string, Engine> engines = {})
      : expression_(expression), engines_(std::move(engines)) {}

  /// Also false for invalid scenarios: a hull without volume, a shape that is too large.
  bool holds(const PairOfTwo& pair);
  /// From now on `unmet` means the unmet expectations of this pair and no others: a pair with two
  /// instead of four points must not become one with none.
  void remember_unmet(const PairOfTwo& pair);
  int requested() const { return queries_; }

  /// Result of the pipeline in double, the default expectation. Empty if the scenario is invalid.
  static std::optional<trace::Pair> in_double(const PairOfTwo& pair);
  /// The pair as a trace of one frame, with its claims if it has any.
  static trace::Trace trace_of(const PairOfTwo& pair);

 private:
  const find::Expression& expression_;
  std::map<std::string, Engine> engines_;
  std::unordered_map<std::string, bool> known_;
  std::optional<std::vector<std::string>> unmet_;
  std::optional<std::size_t> warnings_;  // of the first pair with the property
  int queries_ = 0;
};

}  // namespace contactscope::shrink

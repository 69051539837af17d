#pragma once

#include <map>
#include <span>
#include <string>

#include "peers/peer.h"
#include "peers/round_pair.h"
#include "support/brute_force_sat.h"
#include "support/pair_case.h"

/// Compares another library's contact of two shapes with the truth, and explains differences.
namespace contactscope::peers {

enum class Aspect {
  Touching,  // contact or none
  Normal,    // the overlap along the normal is not the least
  Depth,     // the reported depth is not the overlap along the reported normal
  Deepest,   // on a mesh: the deepest point is on another triangle, or deeper than any
};

struct Comparison {
  const PeerContact& answer;
  double separation;  // the true one, metres
  double tolerance;   // metres: the library's rounding, plus its stopping rule if it iterates
  double overlap;     // along the deepest point's normal; 0 without points
  double reported;    // depth of the deepest point, negative when separated; 0 without points
  const test::PairCase<double>* hulls = nullptr;  // either this or `round` is set
  const RoundPair* round = nullptr;

  double depth() const { return -separation; }
};

Comparison compare(const test::PairCase<double>& pair, const test::BruteForceAxis& truth,
                   const PeerContact& answer, double tolerance);
Comparison compare(const RoundPair& pair, double separation, const PeerContact& answer,
                   double tolerance);

/// A known habit of a library that explains a difference in one aspect.
struct Rule {
  Aspect aspect;
  const char* name;
  bool (*explains)(const Comparison&);
};

/// Counts the answers that agree. For the others, counts the first rule that explains each aspect.
class Tally {
 public:
  explicit Tally(std::span<const Rule> rules) : rules_(rules) {}

  void add(const Comparison& comparison);
  /// Adds a difference that add() does not detect: an answer that differs in this aspect.
  void add(Aspect aspect, const Comparison& comparison);

  int compared() const { return compared_; }
  int agreed() const { return agreed_; }
  /// Number of times that a rule was needed.
  int count(const std::string& rule) const;
  /// Differences that no rule explains, with their numbers; empty if there are none.
  const std::string& unexplained() const { return unexplained_; }
  std::string summary() const;

 private:
  bool explain(Aspect aspect, const Comparison& comparison);

  std::span<const Rule> rules_;
  std::map<std::string, int> counts_;
  std::string unexplained_;
  int compared_ = 0;
  int agreed_ = 0;
};

}  // namespace contactscope::peers

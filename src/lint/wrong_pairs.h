#pragma once

#include <bitset>
#include <string>
#include <unordered_map>
#include <vector>

#include "lint/claims.h"

namespace contactscope::lint {

/// Room for all explanations.
inline constexpr std::size_t kMaxExplanations = 512;

/// A pair of a frame whose claims are wrong, or several that are wrong in the same way.
struct WrongPair {
  int line = 0, frame = 0;
  std::string a, b;
  Problem problem;
  std::string said, is;
  double deeper = 0;  // metres of more overlap than there is, where all points say the same; else 0
  std::bitset<kMaxExplanations> explained_by;
  bool gross = false;  // beyond what an engine's approximations can be
  bool record = false;
  int times = 1;  // as often
};

/// The wrong pairs of a trace of any length: the first some thousand one by one, of those after them only what is new
/// about them, and how often.
class WrongPairs {
 public:
  void add(WrongPair pair);

  int count() const { return count_; }
  /// Of them, how many were not told yet.
  int untold() const;

  auto begin() { return kept_.begin(); }
  auto end() { return kept_.end(); }

 private:
  std::vector<WrongPair> kept_;
  std::unordered_map<std::string, std::size_t> places_;  // of those wrong in some way, among them
  int count_ = 0;
};

}  // namespace contactscope::lint

#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace contactscope::snapshot {

/// Which entries of two lists belong together: indices (expected, actual), in expected order.
struct Match {
  std::vector<std::pair<std::size_t, std::size_t>> both;
  std::vector<std::size_t> gone;   // expected alone
  std::vector<std::size_t> added;  // actual alone

  /// The entries that are in both lists do not stand in the same order.
  bool reordered() const;
};

/// Matches equal keys, the first with the first where a key repeats.
Match match_keys(const std::vector<std::string>& expected, const std::vector<std::string>& actual);

/// Also takes what is gone and what is added at the same index for the same entry.
void match_rest_by_index(Match& match);

}  // namespace contactscope::snapshot

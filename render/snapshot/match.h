#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace contactscope::snapshot {

/// Matching entries of two lists as indices (expected, actual), in expected order.
struct Match {
  std::vector<std::pair<std::size_t, std::size_t>> both;
  std::vector<std::size_t> gone;   // only in expected
  std::vector<std::size_t> added;  // only in actual

  /// The common entries are in a different order.
  bool reordered() const;
};

/// Matches equal keys; repeated keys in order.
Match match_keys(const std::vector<std::string>& expected, const std::vector<std::string>& actual);

/// Also matches a gone and an added entry with the same index.
void match_rest_by_index(Match& match);

}  // namespace contactscope::snapshot

#include "snapshot/match.h"

#include <algorithm>
#include <deque>
#include <unordered_map>

namespace contactscope::snapshot {

bool Match::reordered() const {
  return !std::is_sorted(both.begin(), both.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
}

Match match_keys(const std::vector<std::string>& expected, const std::vector<std::string>& actual) {
  std::unordered_map<std::string, std::deque<std::size_t>> open;
  for (std::size_t i = 0; i < actual.size(); ++i) open[actual[i]].push_back(i);
  Match match;
  std::vector<bool> used(actual.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto found = open.find(expected[i]);
    if (found == open.end() || found->second.empty()) {
      match.gone.push_back(i);
      continue;
    }
    match.both.emplace_back(i, found->second.front());
    used[found->second.front()] = true;
    found->second.pop_front();
  }
  for (std::size_t i = 0; i < actual.size(); ++i) {
    if (!used[i]) match.added.push_back(i);
  }
  return match;
}

void match_rest_by_index(Match& match) {
  std::vector<std::size_t> common;
  std::set_intersection(match.gone.begin(), match.gone.end(), match.added.begin(),
                        match.added.end(), std::back_inserter(common));
  const auto is_common = [&](std::size_t i) {
    return std::binary_search(common.begin(), common.end(), i);
  };
  std::erase_if(match.gone, is_common);
  std::erase_if(match.added, is_common);
  for (const std::size_t i : common) match.both.emplace_back(i, i);
  std::sort(match.both.begin(), match.both.end());
}

}  // namespace contactscope::snapshot

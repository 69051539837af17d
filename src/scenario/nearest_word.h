#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contactscope {

/// The candidate that `word` is most likely a misspelling of: up to a third of its letters wrong,
/// two swapped ones counting as one. Empty when none is near.
std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// "did you mean 'half_extents'? ", or nothing where none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

/// The names of a list of things, to choose from.
template <class List>
std::vector<std::string_view> names_in(const List& list) {
  std::vector<std::string_view> names;
  for (const auto& one : list) names.push_back(one.name);
  return names;
}

/// "'a', 'b' and 'c'".
std::string quoted_list(const std::vector<std::string_view>& words);

}  // namespace contactscope

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contactscope {

/// The candidate that `word` most likely means: the same up to case and underscores; another word for
/// it; or one that it misspells, with up to a third of its letters wrong, two swapped ones counted as
/// one. Empty if none is near.
std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// "did you mean 'half_extents'? ", or empty.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

template <class List> std::vector<std::string_view> names_in(const List& list) {
  std::vector<std::string_view> names;
  for (const auto& one : list) names.push_back(one.name);
  return names;
}

/// "'a', 'b' and 'c'".
std::string quoted_list(const std::vector<std::string_view>& words, const char* last = " and ");

/// "is 'cube'; did you mean 'box'? it may be 'box' or 'hull'"; empty if the text is one of the words, or
/// there are none.
std::string not_among(const std::vector<std::string_view>& words, const std::string& text);

}  // namespace contactscope

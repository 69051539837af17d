#pragma once

#include "core/standard.h"

namespace contactscope {

/// One key of a table that users write: what its reader accepts, and what its reference says.
struct Key {
  std::string_view names;      // of all keys with this meaning: "`a`, `b`"
  std::string_view type;       // "0 to 1e9 m", "`\"y\"`, `\"z\"`"
  std::string_view otherwise;  // the default; or "required", and an example after "as"
  std::string_view text;       // a sentence
  std::string_view name{};
  // From the type:
  std::vector<std::string_view> words{};  // allowed texts; empty: any
  std::string_view range{};               // "0 to 1e9 m", "more than 0, up to 1e6"; empty: no limit
  double low = 0, high = 0;
  bool excludes_low = false;

  bool holds(double value) const {
    return range.empty() || (value <= high && (excludes_low ? value > low : value >= low));
  }
  /// How to write it: "radius = 0.5 (1e-9 to 1e9 m)".
  std::string example() const;
};

struct KeyTable {
  std::string name;          // the heading without marks: "pairs"
  std::string_view heading;  // "`[[pairs]]`"
  std::vector<Key> keys;

  /// Null if there is no such key.
  const Key* find(std::string_view key) const;
};

/// The tables with columns "key | type | default |" of a Markdown document, under their headings.
std::vector<KeyTable> parse_key_tables(std::string_view markdown);

/// For a terminal: a heading for each table, then its keys.
std::string printed(const std::vector<KeyTable>& tables);

/// Without backticks, and the text of each link.
std::string plain(std::string_view markdown);

/// The candidate that `word` most likely means: the same up to case and underscores; another word
/// for it; or one that it misspells in up to a third of its letters. Empty if none is near.
std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// "did you mean 'half_extents'? ", or empty.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);
/// The same with all names: "did you mean 'crate'? known: 'crate' and 'floor'". Of more than
/// twenty, the near one alone, or the first twenty.
std::string near_or_all(std::string_view word, const std::vector<std::string_view>& names);

template <class List> std::vector<std::string_view> names_in(const List& list) {
  std::vector<std::string_view> names;
  for (const auto& one : list) names.push_back(one.name);
  return names;
}

/// "'a', 'b' and 'c'".
std::string quoted_list(const std::vector<std::string_view>& words, const char* last = " and ");

/// "is 'cube'; did you mean 'box'? it may be 'box' or 'hull'"; empty for one of the words.
std::string not_among(const std::vector<std::string_view>& words, const std::string& text);

}  // namespace contactscope

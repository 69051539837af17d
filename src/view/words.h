#pragma once

#include "core/standard.h"

namespace contactscope {

/// Keys of texts that any picture may contain: legend entries, labels and headings, by topic.
/// `contactscope list words` prints them.
const std::vector<std::string_view>& known_words();

/// The part of a key that stands for any text, with its braces: "{n}" of "leans {n}". Empty if the
/// key has none.
std::string_view place_in(std::string_view key);

/// Other texts for those of the program, and other names for shapes and pairs: a [words] table.
class Words {
 public:
  /// Replaces the text that equals `key`, or all texts that differ from it only in its place. `by`
  /// has the same place, or is empty, which hides the text. Later entries replace earlier ones.
  void replace(std::string_view key, const std::string& by);
  /// Renames a shape or pair: alone, after its role as in "A: crate", and before an answer as in
  /// "crate: yes".
  void rename(std::string_view name, const std::string& by);
  void replace(const Words& others);
  bool empty() const { return texts_.empty(); }

  /// A text without an entry stays. Whole texts take precedence over keys with a place.
  std::string of(std::string_view text) const;

 private:
  std::map<std::string, std::string, std::less<>> texts_;
};

/// Name without the number of a copy: "small_crate" for "small_crate_3". Pictures use it for all
/// copies. A name of digits only is returned whole.
std::string_view kind_of_name(std::string_view name);

/// Display form of a scenario's shape name: "small crate 3" for "small_crate3".
std::string name_in_words(std::string_view name);

}  // namespace contactscope

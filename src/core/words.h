#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace contactscope {

/// The program's own texts in pictures, untranslated: legend entries, headings, labels and words in
/// rows. `{n}` is a number with its unit, any other name in braces is any text: "step {n} of {m}".
/// In the order of `contactscope list words`.
const std::vector<std::string_view>& known_words();

/// Translation of the program's own words in pictures.
///
/// An entry replaces the text that equals it or matches its pattern; the texts in its places are
/// translated recursively. Any other text is split at "; ", ", ", ": ", " = ", " × " and
/// parentheses, and its parts are replaced one by one. Text without an entry stays.
class Words {
 public:
  /// A later entry for the same text replaces the earlier one.
  void replace(std::string_view what, std::string_view by);
  void replace(const Words& others);
  bool empty() const { return entries_.empty(); }

  std::string of(std::string_view text) const;

  /// Error message for an entry with a place in braces that the other side lacks. Empty if valid.
  static std::string mistake(std::string_view what, std::string_view by);

 private:
  struct Entry {
    std::string what, by;
    std::vector<std::string> pieces;  // of `what`: literal text, a place, literal text, ...
  };

  std::optional<std::string> whole(std::string_view text, int depth) const;
  std::string translated(std::string_view text, int depth) const;

  std::vector<Entry> entries_;
};

}  // namespace contactscope

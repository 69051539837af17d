#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace contactscope {

/// The texts that the program itself puts into pictures, as it has them: legend entries, headings,
/// labels and the words in rows. `{n}` stands for a number with its unit, any other name in braces
/// for any text: "step {n} of {m}". In the order of `contactscope list words`.
const std::vector<std::string_view>& known_words();

/// What stands in pictures in place of the program's own words, as a translation has it.
///
/// A text is replaced by the entry that is it, or by the one whose pattern it has, whose places are
/// filled with what stood there, translated in its turn. Else it is taken apart at "; ", ", ", ": ",
/// " = ", " × " and parentheses, and its parts are replaced one by one; what no entry knows stays.
class Words {
 public:
  /// A later entry for the same text takes the place of the earlier one.
  void replace(std::string_view what, std::string_view by);
  void replace(const Words& others);
  bool empty() const { return entries_.empty(); }

  std::string of(std::string_view text) const;

  /// What is wrong with an entry, in words: a place in braces that the other side lacks. Empty where
  /// nothing is.
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

#include "scenario/words_file.h"

#include "scenario/readers.h"

namespace contactscope {

Words scenario_file::read_words_table(const Value& table,
                                      const std::vector<std::string_view>& names) {
  std::vector<std::string_view> known = known_words();
  known.insert(known.end(), names.begin(), names.end());
  Words words;
  for (const Value& entry : table.members()) {
    if (std::ranges::find(known, entry.name()) == known.end()) {
      const std::string near = nearest(entry.name(), known);
      entry.fail(
          "no picture has the word '" + entry.name() + "'; " +
          (near.empty() ? "`contactscope list words` prints all" : "did you mean '" + near + "'?"));
    }
    const std::string by = entry.string();
    if (!by.empty() && place_in(by) != place_in(entry.name()))
      entry.fail("'" + by + "' and '" + entry.name() + "' need the same place in braces");
    if (std::ranges::find(names, entry.name()) != names.end())
      words.rename(entry.name(), by);
    else
      words.replace(entry.name(), by);
  }
  return words;
}

Words load_words(const std::string& path, const std::vector<std::string_view>& names) {
  using scenario_file::Value;
  const toml::table document = scenario_file::read_document(path);
  const auto table = Value(path, document, "").find("words");
  return table ? scenario_file::read_words_table(*table, names) : Words();
}

}  // namespace contactscope

#pragma once

#include "view/words.h"

namespace contactscope {

struct Scenario;

namespace scenario_file {
class Value;

/// A [words] table: texts of pictures, or `names`, with their replacements. Throws InputError for an
/// unknown text, or if a replacement loses its place.
Words read_words_table(const Value& table, const std::vector<std::string_view>& names);
}  // namespace scenario_file

/// Names of a scenario that appear in pictures: of shapes and their kinds, and labels of pairs.
std::vector<std::string_view> names_in_pictures(const Scenario& scenario);

/// The [words] table of a file, which may contain more; empty without one. `names` can be replaced
/// in addition to the built-in texts. Throws InputError.
Words load_words(const std::string& path, const std::vector<std::string_view>& names);

}  // namespace contactscope

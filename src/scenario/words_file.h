#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/words.h"

namespace contactscope {

struct Scenario;

namespace scenario_file {
class Value;

/// A [words] table: the program's own words for pictures, or names of the scenario, each with what
/// stands in its place. Throws InputError at a word that is none of these, or whose numbers are lost.
Words read_words_table(const Value& table, const std::vector<std::string_view>& names);
}  // namespace scenario_file

/// What a scenario names that pictures show: title, source, shapes, labels of pairs.
std::vector<std::string_view> names_in_pictures(const Scenario& scenario);

/// The [words] table of a file that may hold more; no words where it has none. `names`: what may be
/// replaced beside the program's own words. Throws InputError.
Words load_words(const std::string& path, const std::vector<std::string_view>& names);

}  // namespace contactscope

#include "scenario/keys.h"

namespace contactscope {

/// scenarios/README.md.
std::string_view scenario_reference();

const std::vector<KeyTable>& scenario_file::key_tables() {
  static const std::vector<KeyTable> tables = parse_key_tables(scenario_reference());
  return tables;
}

const KeyTable& scenario_file::key_table(std::string_view name) {
  return *std::ranges::find(key_tables(), name, &KeyTable::name);
}

}  // namespace contactscope

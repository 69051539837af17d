#include "trace/json.h"

namespace contactscope {

/// README.md of this folder.
std::string_view trace_reference();

const std::vector<KeyTable>& trace::fact_tables() {
  static const std::vector<KeyTable> tables = parse_key_tables(trace_reference());
  return tables;
}

const Key* trace::fact_key(std::string_view table, std::string_view key) {
  const auto found = std::ranges::find(fact_tables(), table, &KeyTable::name);
  return found == fact_tables().end() ? nullptr : found->find(key);
}

}  // namespace contactscope

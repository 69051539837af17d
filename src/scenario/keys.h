#pragma once

#include "core/key_table.h"

/// The keys of scenario files. The tables are those of scenarios/README.md, which is built in.
namespace contactscope::scenario_file {

const std::vector<KeyTable>& key_tables();

/// The table of a name: "The file", "solver", "Box", "rotation".
const KeyTable& key_table(std::string_view name);

}  // namespace contactscope::scenario_file

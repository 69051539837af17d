#pragma once

#include "core/key_table.h"

/// The keys of a trace. The tables are those of README.md, which is built in.
namespace contactscope::trace {

/// "Header", "Shape", "Frame", "Pair", "Manifold", "Point", and "Stages", whose sentences also name the
/// keys in each stage.
const std::vector<KeyTable>& fact_tables();

/// A key of one of these tables; null if it is not there.
const Key* fact_key(std::string_view table, std::string_view key);

}  // namespace contactscope::trace

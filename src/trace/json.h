#pragma once

#include "core/key_table.h"
#include "trace/trace.h"

namespace contactscope::trace {

/// Schema of every header line; readers reject any other.
inline constexpr const char* kSchema = "contactscope.trace/1";

/// One line of JSON without the newline, keys in the order of README.md, "Trace". Numbers
/// round-trip to the same double, including -0.0. Throws std::domain_error with the key for nan and
/// infinity, which JSON cannot represent.
std::string to_json_line(const Header& header);
std::string to_json_line(const Frame& frame);

struct Trace {
  Header header;
  std::vector<Frame> frames;
};

/// Reads JSON lines. `name` is the file's name in messages. Throws core's InputError with line and
/// column if a line is not JSON, the schema differs, a key is missing or has the wrong type, or an
/// index is out of range. Except for broken JSON, the message names the place in the line and the
/// column is 1. Unknown keys are ignored so that other engines can add their own; keys that
/// README.md does not call needed may be missing or null. Blank lines are skipped.
Trace read_trace(std::istream& in, const std::string& name);

// reference.cpp: the keys of a trace. The tables are those of README.md, which is built in.

/// "Header", "Shape", "Frame", "Pair", "Manifold", "Point", and "Stages", whose sentences also name the
/// keys in each stage.
const std::vector<KeyTable>& fact_tables();

/// A key of one of these tables; null if it is not there.
const Key* fact_key(std::string_view table, std::string_view key);

}  // namespace contactscope::trace

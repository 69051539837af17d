#pragma once

#include <iosfwd>
#include <string>
#include <string_view>

#include "trace/trace.h"

namespace contactscope::trace {

/// One line of JSON without the newline, as FORMATS.md, "Trace", lays it out. Numbers read back to
/// the same double.
std::string to_json_line(const Header& header);
std::string to_json_line(const Frame& frame);

/// A whole trace.
struct Trace {
  Header header;
  std::vector<Frame> frames;
};

/// Reads JSON lines back. `name` is the file's name for messages. Throws core's InputError with line
/// and column when a line is no JSON, the schema differs, or a key has the wrong type; keys that are
/// not known are passed over, so that traces of other engines may carry more.
Trace read_trace(std::istream& in, const std::string& name);

}  // namespace contactscope::trace

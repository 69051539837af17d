#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "trace/trace.h"

namespace contactscope::trace {

/// First words of every header line; a reader refuses any other.
inline constexpr const char* kSchema = "contactscope.trace/1";

/// One line of JSON without the newline, as README.md, "Trace", lays it out; keys in that order.
/// Numbers read back to the same double, -0.0 too. JSON has no spelling for nan and infinity: they
/// throw std::domain_error that names the key.
std::string to_json_line(const Header& header);
std::string to_json_line(const Frame& frame);

/// A whole trace.
struct Trace {
  Header header;
  std::vector<Frame> frames;
};

/// Reads JSON lines back. `name` is the file's name for messages. Throws core's InputError with
/// line and column when a line is no JSON, the schema differs, a key is missing or has the wrong
/// type, or an index points nowhere; for anything but broken JSON the message names the place in
/// the line and the column is 1. Keys that are not known are passed over, so that traces of other
/// engines may carry more; keys that README.md does not call needed may be missing, or null. Lines
/// of white space are skipped.
Trace read_trace(std::istream& in, const std::string& name);

}  // namespace contactscope::trace

#pragma once

#include <string>

#include "snapshot/finding.h"

/// An Outcome as the file OUT/check/findings.json has it; src/trace/README.md, "Findings", lays it out. There
/// is nothing in it that two runs on the same files would tell otherwise, such as a time.
namespace contactscope::snapshot {

inline constexpr const char* kFindingsSchema = "contactscope.check/1";

/// The whole file, in lines for people, with the last line's end.
std::string to_json(const Outcome& outcome);

/// Throws core's InputError where the text is no such file; `name` is the file's.
Outcome parse_outcome(const std::string& text, const std::string& name);

}  // namespace contactscope::snapshot

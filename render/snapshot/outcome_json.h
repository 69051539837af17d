#pragma once

#include <string>

#include "snapshot/finding.h"

/// An Outcome as the file OUT/check/findings.json; see src/trace/README.md, "Findings". It has no
/// times or other data that differ between runs on the same files.
namespace contactscope::snapshot {

inline constexpr const char* kFindingsSchema = "contactscope.check/1";

/// The whole file, indented, with a final newline.
std::string to_json(const Outcome& outcome);

/// Throws core's InputError for invalid text; `name` is the file name.
Outcome parse_outcome(const std::string& text, const std::string& name);

}  // namespace contactscope::snapshot

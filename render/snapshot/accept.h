#pragma once

#include <filesystem>
#include <string>

#include "snapshot/finding.h"

namespace contactscope::snapshot {

/// Matches a finding against a pattern of the command line: its key, with or without the word of
/// the compared baseline, a folder above it ("hull", "hull/face_contact"), or either with the
/// wildcards * and ?.
bool names(const std::string& pattern, const Finding& finding);

/// A pattern that matches only this key: wildcards and a leading option dash are escaped with a
/// backslash.
std::string pattern_of(const std::string& key);

/// How a candidate is stored.
struct Acceptance {
  std::string word{};  // "osmesa": next to the stored file, as frame_0012.osmesa.png
  std::string note{};  // for a word that starts with "bad_": text of frame_0012.bad_31.txt
};

/// Stores the candidate of a finding as `check --update` does, without running or drawing anything,
/// and removes obsolete files. A candidate under a word that starts with "bad_" is recorded as
/// known bad and still fails. Returns the reason for a refusal, or an empty text: the stored file
/// or the candidate has changed since the report, or there is nothing to store. `report` is the
/// folder of findings.json. Throws std::filesystem::filesystem_error.
std::string accept(const std::filesystem::path& report, const std::filesystem::path& snapshots,
                   Finding& finding, const Acceptance& how = {});

}  // namespace contactscope::snapshot

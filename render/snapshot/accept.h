#pragma once

#include <filesystem>
#include <string>

#include "snapshot/finding.h"

namespace contactscope::snapshot {

/// Matches a finding against a pattern: its key, with or without the word of the compared
/// baseline, a folder above it ("hull", "hull/face_contact"), or either with wildcards * and ?.
bool names(const std::string& pattern, const Finding& finding);

/// A pattern that matches only this key: wildcards and a leading option dash are escaped with a
/// backslash.
std::string pattern_of(const std::string& key);

/// How a candidate is stored.
struct Acceptance {
  std::string word{};  // "osmesa": next to the stored file, as frame_0012.osmesa.png
  std::string note{};  // for a word that starts with "bad_": text of frame_0012.bad_31.txt
};

/// Stores the candidate of a finding like `check --update`, without a run, and removes obsolete
/// files. With a word that starts with "bad_", the candidate becomes known bad and still fails.
/// Returns why it refused, else an empty text: the files changed since the report, or there is
/// nothing to store. `report` has findings.json. Throws std::filesystem::filesystem_error.
std::string accept(const std::filesystem::path& report, const std::filesystem::path& snapshots,
                   Finding& finding, const Acceptance& how = {});

}  // namespace contactscope::snapshot

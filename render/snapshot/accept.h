#pragma once

#include <filesystem>
#include <string>

#include "snapshot/finding.h"

namespace contactscope::snapshot {

/// Whether a pattern of the command line names a finding: its key, with or without the word of the baseline that it
/// was held against, a folder above it ("hull", "hull/face_contact"), or either with * for any letters and ? for one.
bool names(const std::string& pattern, const Finding& finding);

/// The pattern that names this key alone: what is a mark to names(), or to a command line the beginning of an option, has a
/// backslash before it.
std::string pattern_of(const std::string& key);

/// As what a candidate is stored.
struct Acceptance {
  std::string word{};  // "osmesa": as frame_0012.osmesa.png, beside what is stored
  std::string note{};  // of a word that begins with "bad_": what frame_0012.bad_31.txt says
};

/// Stores the candidate of a finding, as `check --update` would have: nothing is run or drawn for it. What nobody asks
/// for any more is removed. What is kept under a word that begins with "bad_" is rejected by that, and fails as before. Returns why that was refused, empty where it was done: the stored file, or the
/// candidate, is not the one any more that the report tells of, or there is nothing to store.
/// `report` is the folder of findings.json. Throws std::filesystem::filesystem_error.
std::string accept(const std::filesystem::path& report, const std::filesystem::path& snapshots,
                   Finding& finding, const Acceptance& how = {});

}  // namespace contactscope::snapshot

#pragma once

#include "snapshot/finding.h"

/// Decides the action after a comparison. Pure: environment and command line are in the policy.
namespace contactscope::snapshot {

/// Files that a check may write into the snapshot folder.
enum class Update {
  None,
  Missing,  // files that are missing, by --write-missing
  Failed,   // also changed and orphaned files, by --update
  All,      // also unchanged ones, after a change of the file format or compression
};

struct Policy {
  bool ci = false;  // never write or remove anything, whatever `update` is
  Update update = Update::None;

  constexpr Update allowed() const { return ci ? Update::None : update; }
};

/// Tests the environment variable CI for "true" or "1"; null if it is not set.
inline bool is_ci(const char* value) {
  const std::string_view text = value ? value : "";
  return text == "true" || text == "1";
}

/// Action on the stored file. Nothing is written without a request: a snapshot must be reviewed
/// before it is accepted.
constexpr Done decide(FindingKind kind, const Policy& policy) {
  const Update update = policy.allowed();
  switch (kind) {
    case FindingKind::New:
    case FindingKind::Missing:
      return update >= Update::Missing ? Done::Written : Done::Nothing;
    case FindingKind::Orphaned:
      return update >= Update::Failed ? Done::Removed : Done::Nothing;
    case FindingKind::UnmetExpectation:
    case FindingKind::KnownBad:
    case FindingKind::UnreadableScenario:
      return Done::Nothing;  // fix the scenario or the bug instead
    case FindingKind::Changed:
    case FindingKind::Unreadable:
      break;
  }
  return update >= Update::Failed ? Done::Updated : Done::Nothing;
}

}  // namespace contactscope::snapshot

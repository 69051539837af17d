#pragma once

#include <string_view>

#include "snapshot/finding.h"

/// What follows from a comparison. Pure: the environment and the command line come in as a policy.
namespace contactscope::snapshot {

/// What a check may write into the folder of snapshots.
enum class Update {
  None,
  Missing,  // what nothing is stored of, by --write-missing
  Failed,   // also what differs or is orphaned, by --update
  All,      // also what is the same: after a change of the file format or the compression
};

struct Policy {
  bool ci = false;  // nothing is ever written or removed, whatever `update` says
  Update update = Update::None;

  constexpr Update allowed() const { return ci ? Update::None : update; }
};

/// Of the environment variable CI: "true" or "1". Null where it is not set.
inline bool is_ci(const char* value) {
  const std::string_view text = value ? value : "";
  return text == "true" || text == "1";
}

/// What becomes of the stored file. Nothing is written where nobody asked for it: a snapshot is not
/// agreed on until somebody has looked at it.
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
      return Done::Nothing;  // that is for whoever wrote the scenario, or knows the bug
    case FindingKind::Changed:
    case FindingKind::Unreadable:
      break;
  }
  return update >= Update::Failed ? Done::Updated : Done::Nothing;
}

}  // namespace contactscope::snapshot

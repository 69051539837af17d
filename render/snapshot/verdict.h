#pragma once

#include <string_view>

/// What follows from a comparison. Pure: the environment and the command line come in as a policy.
namespace contactscope::snapshot {

/// What `check --update[=all]` may rewrite.
enum class Update {
  None,
  Failed,  // what differs, is missing or is stale
  All,     // also what is the same: after a change of the file format or the compression
};

struct Policy {
  bool ci = false;  // nothing is ever written or removed, whatever `update` says
  Update update = Update::None;
};

/// Of the environment variable CI: "true" or "1". Null where it is not set.
inline bool is_ci(const char* value) {
  const std::string_view text = value ? value : "";
  return text == "true" || text == "1";
}

/// What a comparison found.
enum class Finding {
  Same,
  Different,
  Missing,  // nothing is stored
  Stale,    // stored, but the scenario does not store it any more
};

/// What becomes of the stored file: from Written on it changes.
enum class Verdict {
  Same,
  Different,
  Missing,  // and not written
  Stale,    // and not removed
  Written,  // was missing
  Updated,  // rewritten
  Removed,  // was stale
};

struct Decision {
  Verdict verdict = Verdict::Same;
  bool fails = false;  // the check exits with 1
};

/// A missing snapshot is written where nobody asked for it, but fails the check: it is not agreed
/// on until somebody has looked at it and committed it.
constexpr Decision decide(Finding finding, const Policy& policy) {
  const Update update = policy.ci ? Update::None : policy.update;
  const bool accepted = update != Update::None;
  switch (finding) {
    case Finding::Same:
      return {update == Update::All ? Verdict::Updated : Verdict::Same, false};
    case Finding::Missing:
      return {policy.ci ? Verdict::Missing : Verdict::Written, !accepted};
    case Finding::Stale:
      return {accepted ? Verdict::Removed : Verdict::Stale, !accepted};
    case Finding::Different:
      break;
  }
  return {accepted ? Verdict::Updated : Verdict::Different, !accepted};
}

}  // namespace contactscope::snapshot

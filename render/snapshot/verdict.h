#pragma once

#include <string_view>

/// What follows from a comparison. Pure: the environment and the command
/// line come in as a policy.
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
bool is_ci(const char* value);

/// What a comparison found.
enum class Finding {
  Same,
  Different,
  Missing,  // nothing is stored
  Stale,    // stored, but the scenario does not store it any more
};

enum class Verdict {
  Same,
  Different,
  Missing,  // and not written
  Stale,    // and not removed
  Written,  // was missing
  Updated,  // rewritten
  Removed,  // was stale
};

/// "same", "different", ..., as reports spell it.
const char* to_string(Verdict verdict);

/// What to do with the stored file.
enum class Action { Keep, Write, Remove };

struct Decision {
  Verdict verdict = Verdict::Same;
  Action action = Action::Keep;
  bool fails = false;  // the check exits with 1
};

/// A missing snapshot is written where nobody asked for it, but fails the check: it is not agreed
/// on until somebody has looked at it and committed it.
Decision decide(Finding finding, const Policy& policy);

}  // namespace contactscope::snapshot

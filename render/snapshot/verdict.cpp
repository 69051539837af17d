#include "snapshot/verdict.h"

namespace contactscope::snapshot {

bool is_ci(const char* value) {
  const std::string_view text = value ? value : "";
  return text == "true" || text == "1";
}

const char* to_string(Verdict verdict) {
  constexpr const char* kNames[] = {"same",    "different", "missing", "stale",
                                    "written", "updated",   "removed"};
  return kNames[static_cast<int>(verdict)];
}

Decision decide(Finding finding, const Policy& policy) {
  const Update update = policy.ci ? Update::None : policy.update;
  switch (finding) {
    case Finding::Same:
      if (update == Update::All) return {Verdict::Updated, Action::Write, false};
      return {Verdict::Same, Action::Keep, false};
    case Finding::Different:
      if (update != Update::None) return {Verdict::Updated, Action::Write, false};
      return {Verdict::Different, Action::Keep, true};
    case Finding::Missing:
      if (policy.ci) return {Verdict::Missing, Action::Keep, true};
      return {Verdict::Written, Action::Write, update == Update::None};
    case Finding::Stale:
      if (update != Update::None) return {Verdict::Removed, Action::Remove, false};
      return {Verdict::Stale, Action::Keep, true};
  }
  return {Verdict::Different, Action::Keep, true};
}

}  // namespace contactscope::snapshot

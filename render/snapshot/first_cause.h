#pragma once

#include <string>
#include <vector>

#include "snapshot/compare_facts.h"
#include "snapshot/margins.h"
#include "trace/json.h"

namespace contactscope::snapshot {

/// What differs of one frame, or of the header, whose number is -1.
struct FrameDifferences {
  int frame = -1;
  const trace::Frame* expected = nullptr;  // null of the header
  const trace::Frame* actual = nullptr;
  std::vector<Difference> differences;
};

/// What a changed trace is told by.
struct FirstCause {
  /// "hull/face_contact frame 12, table-crate: the separating axis test now prefers face b: -19.98 mm against
  /// -20.01 mm of face a, a tie of 0.03 mm; so the reference face, 4 clip steps and 3 of 4 ids changed".
  std::string sentence;
  /// Where and how in the pipeline, without a number or a name: equal for traces that one edit of the
  /// program may have changed.
  std::string signature;
  /// It stands in the scenario's file: a shape, a setting, or a pose that no solver has moved yet.
  bool is_input = false;
};

/// The first frame in which anything differs, and in it what the pipeline decides first: all else may follow
/// from it. Where that is a number that moved, also the first choice that came out otherwise after it. `frames`
/// is not empty, in their order, the header first; `margins` are of the actual ones.
FirstCause first_cause(const std::string& scenario, const std::vector<FrameDifferences>& frames,
                       const Margins& margins = {});

}  // namespace contactscope::snapshot

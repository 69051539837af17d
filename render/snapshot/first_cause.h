#pragma once

#include <optional>
#include <string>
#include <vector>

#include "snapshot/brittle.h"
#include "snapshot/compare_facts.h"
#include "trace/json.h"
#include "trace/pair.h"

namespace contactscope::snapshot {

/// Differences of one frame, or of the header (frame -1).
struct FrameDifferences {
  int frame = -1;
  const trace::Frame* expected = nullptr;  // null for the header
  const trace::Frame* actual = nullptr;
  std::vector<Difference> differences;
};

/// Summary of a changed trace.
struct FirstCause {
  /// "hull/face_contact frame 12, table-crate: the separating axis test now prefers face b: -19.98 mm against
  /// -20.01 mm of face a, a tie of 0.03 mm; so the reference face, 4 clip steps and 3 of 4 ids changed".
  std::string sentence;
  int frame = -1;  // of the first difference; -1: the header
  const Difference* first = nullptr;
  std::string chain;  // a part of the sentence: what changed first, and what followed
  /// Place and kind of the change in the pipeline, without numbers or names: equal for traces that
  /// one edit of the program may have changed.
  std::string signature;
  /// The scenario's file changed: a shape, a setting, or a pose that no solver has moved yet.
  bool is_input = false;
};

/// Finds the first frame with a difference and in it the earliest stage of the pipeline; the rest
/// may follow from it. If a number moved, also finds the next choice that flipped. `frames` is
/// sorted, header first, and not empty; `margins` belong to the actual frames.
FirstCause first_cause(const std::string& scenario, const std::vector<FrameDifferences>& frames,
                       const Margins& margins = {});

/// A choice of the pipeline that differs from the stored trace.
struct Flipped {
  Stage stage = Stage::Decision;
  std::string subject{};  // the pair, "crate-floor"
  /// "the separating axis test now prefers face b: -19.98 mm against -20.01 mm of face a, a tie of 0.03 mm".
  std::string sentence{};

  /// True if the sentence already covers a difference of its pair.
  bool says(const Difference& difference) const;
};

/// The first flipped choice of a pair: contact or not, axis, best face of a hull, incident face,
/// points kept by a reducer. `margins` are those of `now`; without them the sentence has no margin.
std::optional<Flipped> find_flipped(const trace::Pair& before, const trace::Pair& now,
                                    const std::vector<trace::Decision>& margins);

}  // namespace contactscope::snapshot

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "snapshot/compare_facts.h"
#include "trace/pair.h"

namespace contactscope::snapshot {

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

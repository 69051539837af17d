#pragma once

#include <optional>
#include <string>
#include <vector>

#include "snapshot/compare_facts.h"
#include "trace/pair.h"

namespace contactscope::snapshot {

/// A choice of the pipeline that came out otherwise than in the stored trace.
struct Flipped {
  Stage stage = Stage::Decision;
  std::string subject{};  // the pair, "crate-floor"
  /// "the separating axis test now prefers face b: -19.98 mm against -20.01 mm of face a, a tie of 0.03 mm".
  std::string sentence{};

  /// Whether a difference of its pair says no more than the sentence does.
  bool says(const Difference& difference) const;
};

/// The first of a pair: whether the shapes touch, the axis, the best face of a hull that made it, the incident
/// face, the points that a reducer keeps. `margins` are those of `now`; without one its sentence says none.
std::optional<Flipped> find_flipped(const trace::Pair& before, const trace::Pair& now,
                                    const std::vector<trace::Decision>& margins);

}  // namespace contactscope::snapshot

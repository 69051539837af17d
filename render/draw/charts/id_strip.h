#pragma once

#include <cstdint>
#include <vector>

#include "draw/scene/pen.h"

namespace contactscope::draw {

/// What became of a contact id in one frame.
enum class IdState : std::uint8_t { Absent, Dropped, Kept };

/// Ids over the time of a sequence: one row an id, grey while the point is there, vermilion while it
/// is kept. Made once a sequence; a picture costs what it shows of it.
class IdHistory {
 public:
  IdHistory() = default;
  /// `rows`: a state for every frame; `pairs`: of each row its pair, those of one pair need not be
  /// next to each other.
  IdHistory(const std::vector<std::vector<IdState>>& rows, const std::vector<std::size_t>& pairs);

  std::size_t row_count() const { return rows_.size(); }
  std::size_t pair_count() const { return bands_.size(); }

  /// Frames before `until`; a line marks frame `moment`.
  void draw_rows(const Rect& strip, std::size_t moment, std::size_t until, const Pen& pen) const;

  /// The same where rows would be too many to tell apart: one band a pair, the first `count`, up to
  /// `moment`, as high as it has kept points of the most that it has had until then, and cut where
  /// one of them becomes another.
  void draw_bands(const Rect& strip, std::size_t moment, std::size_t count, const Pen& pen) const;

 private:
  /// Frames in which nothing changes.
  struct Run {
    std::size_t from = 0, length = 0;
    IdState state = IdState::Absent;  // of a row
    std::size_t kept = 0;             // points of a band
  };
  /// On the strip, as far as its frames are before `until`.
  Rect place_of(const Run& run, const Rect& strip, std::size_t until) const;

  std::size_t frames_ = 0;
  std::vector<std::vector<Run>> rows_;   // in the order of the pairs
  std::vector<std::vector<Run>> bands_;  // a pair each
};

}  // namespace contactscope::draw

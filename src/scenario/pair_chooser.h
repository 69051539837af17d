#pragma once

#include "broadphase/broad_phase.h"
#include "scenario/scenario.h"

namespace contactscope {

/// The broad phase of a scenario without listed pairs. Keeps the state of the previous frame for
/// broad phases that use it; copies have a state of their own.
class PairChooser {
 public:
  /// Selects nothing if the scenario names no broad phase. Keeps a reference to the scenario.
  explicit PairChooser(const Scenario& scenario);
  PairChooser(const PairChooser& other)
      : scenario_(other.scenario_),
        phase_(other.phase_ ? other.phase_->clone() : nullptr),
        any_dynamic_(other.any_dynamic_),
        answered_(other.answered_) {}
  PairChooser& operator=(const PairChooser&) = delete;
  bool chooses() const { return phase_ != nullptr; }

  /// Metres within which narrow phase and solver look for contacts; boxes are expanded by half.
  double reach() const;

  /// The pairs of the next frame, ascending: shapes with overlapping boxes that make contacts, one
  /// of them dynamic if any shape is. `boxes`: one per shape, world; an empty box belongs to a body
  /// whose state is not finite, and overlaps all. Recorded in `record` unless null. `cells`:
  /// include the data of Stages::cells.
  std::vector<BoxPair> choose(const std::vector<Aabb<float>>& boxes, trace::Frame* record,
                              bool cells);

 private:
  /// Records the structure, clipped to the bounds of the world's boxes.
  void report(const BroadPhaseRecord& structure, trace::BroadPhase& facts) const;

  const Scenario& scenario_;
  std::unique_ptr<BroadPhase> phase_;
  bool any_dynamic_;
  /// Whether two kinds of shapes support the scenario's query, faster than with the reason.
  std::array<std::array<bool, kShapeKinds>, kShapeKinds> answered_{};
};

}  // namespace contactscope

#pragma once

#include <array>
#include <memory>
#include <vector>

#include "broadphase/broad_phase.h"
#include "scenario/scenario.h"
#include "trace/trace.h"

namespace contactscope {

/// The broad phase of a scenario that lists no pairs. It remembers the frame before, as some broad
/// phases go by it; a copy goes on by itself.
class PairChooser {
 public:
  /// Chooses nothing where the scenario names no broad phase. Holds on to the scenario.
  explicit PairChooser(const Scenario& scenario);
  PairChooser(const PairChooser& other)
      : scenario_(other.scenario_),
        phase_(other.phase_ ? other.phase_->clone() : nullptr),
        any_dynamic_(other.any_dynamic_),
        answered_(other.answered_) {}
  PairChooser& operator=(const PairChooser&) = delete;

  bool chooses() const { return phase_ != nullptr; }

  /// How far the narrow phase and the solver look for contacts, metres: two boxes that each stand out
  /// by half of it miss none.
  double reach() const;

  /// The next frame's pairs, ascending: boxes that overlap, of shapes that make contacts, one of them
  /// dynamic where any is. `boxes`: one a shape, world; an empty one is that of a body which the
  /// solver lost, and meets all. ReportInput in `record` unless that is null.
  /// `cells`: with what Stages::cells is about.
  std::vector<BoxPair> choose(const std::vector<Aabb<float>>& boxes, trace::Frame* record,
                              bool cells);

 private:
  /// What the structure looks like, cut to the world's boxes.
  void report(const BroadPhaseRecord& structure, trace::BroadPhase& facts) const;

  const Scenario& scenario_;
  std::unique_ptr<BroadPhase> phase_;
  bool any_dynamic_;
  /// Whether two kinds of shapes can be asked what the scenario asks; a reason why not takes longer to
  /// find than a pair to choose.
  std::array<std::array<bool, kShapeKinds>, kShapeKinds> answered_{};
};

}  // namespace contactscope

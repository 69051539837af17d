#pragma once

#include "broadphase/broad_phase.h"
#include "scenario/scenario.h"

namespace contactscope {

/// Runs the frames of one scenario, forwards only, since pairs and bodies depend on the previous
/// frame. Skipped frames are run without recording; they cost nothing if no state is kept. A copy
/// continues independently.
///
/// Shapes are rounded to the scenario's scalar once, here. Keeps a reference to the scenario, which
/// must outlive it unchanged. In dynamic scenarios a frame contains the bodies before its step, the
/// contacts there, and the impulses of the step.
class Runner {
 public:
  /// `stages`: the optional stages to record.
  explicit Runner(const Scenario& scenario, const trace::Stages& stages = {});
  explicit Runner(Scenario&&, const trace::Stages& stages = {}) = delete;
  Runner(const Runner& other) : in_scalar_(other.in_scalar_->copy()) {}
  Runner& operator=(const Runner& other) {
    in_scalar_ = other.in_scalar_->copy();
    return *this;
  }

  /// The trace's first line: shapes and settings, with vertices rounded to the pipeline's scalar.
  /// It has no reducers or scalars of single pairs; stages name theirs.
  trace::Header header() const { return in_scalar_->header(); }

  /// Poses and recorded pairs of one frame, which must be later than the last one requested (0 <=
  /// frame, also beyond the scenario's end). Poses are evaluated in double and rounded to the
  /// scalar, as the pipeline used them. Pairs are in the scenario's order.
  trace::Frame frame(int frame) { return in_scalar_->run(frame, true); }

  /// With only the manifolds recorded, as a physics engine would call it: `sat`, `clip` and
  /// `reduction` are empty. `separation` is the deepest point's, or 0 if separated.
  trace::Frame frame_unrecorded(int frame) { return in_scalar_->run(frame, false); }

  /// Advances until `frame` is the next one, keeping the state that it depends on.
  void advance(int frame) { in_scalar_->advance(frame); }

 private:
  /// The implementation in float or double.
  struct InScalar {
    virtual ~InScalar() = default;
    virtual std::unique_ptr<InScalar> copy() const = 0;
    virtual trace::Header header() const = 0;
    virtual trace::Frame run(int frame, bool recorded) = 0;
    virtual void advance(int frame) = 0;
  };
  template <class S> class In;

  std::unique_ptr<InScalar> in_scalar_;
};

/// Expectations that these frames do not meet, one sentence each, such as
/// "scenarios/hull/face_contact.toml:31: frames 12 to 14, crate-floor: expected 4 points, got 2".
/// It gives the first frame's value, and says if others differ. Empty if all hold. Keys are tested
/// independently: `points` counts over all manifolds, `normal` is compared per component and
/// `separation` with the pair's, both within the tolerance, inclusive. For a separated pair, `axis`
/// and `normal` are the separating axis, which needs a recorded frame. A missing pair fails.
std::vector<std::string> unmet_expectations(const Scenario& scenario,
                                            const std::vector<trace::Frame>& frames);

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

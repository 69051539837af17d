#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "trace/trace.h"

namespace contactscope {

/// Runs the frames of one scenario, forwards only: a pair may go by what was kept in the frame before,
/// as temporal coherence, some reducers and incremental manifolds do, and bodies that the solver
/// moves are where the last step left them. Frames that are passed over are run for that, with
/// nothing recorded; where nothing is kept they cost nothing. A copy goes on by itself, as the
/// original would have.
///
/// Shapes are rounded to the scenario's scalar once, here. Holds on to the scenario, which must
/// outlive it and stay as it is. Where shapes are dynamic, a frame shows the bodies before its step,
/// the contacts found there, and what the solver gave them in the step.
class Runner {
 public:
  /// `stages`: the optional stages that recorded frames hold.
  explicit Runner(const Scenario& scenario, const trace::Stages& stages = {});
  explicit Runner(Scenario&&, const trace::Stages& stages = {}) = delete;
  Runner(const Runner& other) : in_scalar_(other.in_scalar_->copy()) {}
  Runner& operator=(const Runner& other) {
    in_scalar_ = other.in_scalar_->copy();
    return *this;
  }

  /// The trace's first line: shapes and settings. Vertices are those that the pipeline sees,
  /// rounded to its scalar. A reducer or scalar of a pair is not among the settings: stages name
  /// theirs.
  trace::Header header() const { return in_scalar_->header(); }

  /// Poses and recorded pairs of one frame, later than the last one that was asked for (0 <= frame,
  /// also beyond the scenario's last). Poses are evaluated in double and rounded to the scalar, and
  /// are written as the pipeline saw them. Pairs are in the scenario's order.
  trace::Frame frame(int frame) { return in_scalar_->run(frame, true); }

  /// The same pipeline with nothing recorded but the manifolds themselves, in the way a physics
  /// engine would call it: `sat`, `clip` and `reduction` are empty. `separation` is that of the
  /// deepest point, and 0 when separated: how far apart, only a recorded frame says.
  trace::Frame frame_unrecorded(int frame) { return in_scalar_->run(frame, false); }

  /// Goes on to where `frame` is the next one, and keeps of the frames before it what that one depends on.
  void advance(int frame) { in_scalar_->advance(frame); }

 private:
  /// A scenario in float or double.
  struct InScalar {
    virtual ~InScalar() = default;
    virtual std::unique_ptr<InScalar> copy() const = 0;
    virtual trace::Header header() const = 0;
    virtual trace::Frame run(int frame, bool recorded) = 0;
    virtual void advance(int frame) = 0;
  };
  template <class S>
  class In;

  std::unique_ptr<InScalar> in_scalar_;
};

/// What of the scenario's expectations these frames do not meet: one sentence for each thing, such as
/// "scenarios/hull/face_contact.toml:31: frames 12 to 14, crate-floor: expected 4 points, got 2",
/// with what the first of them got; where others got something else, it says so. Empty when all hold.
/// Every key is judged by itself: `points` counts over all manifolds, `normal` is compared component
/// by component and `separation` with the pair's, both within the tolerance, the bound included. Of a
/// separated pair, `axis` and `normal` are those of the separating axis, which only a recorded frame
/// has. A pair that the frame lacks is not met.
std::vector<std::string> unmet_expectations(const Scenario& scenario,
                                            const std::vector<trace::Frame>& frames);

}  // namespace contactscope

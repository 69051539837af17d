#pragma once

#include <map>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

#include "broadphase/broad_phase.h"
#include "core/feature_id.h"
#include "dynamics/solver.h"
#include "manifold/dispatch.h"
#include "manifold/incremental.h"
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

  /// The trace's first line: shapes and settings. Vertices are those that the pipeline sees,
  /// rounded to its scalar. A reducer or scalar of a pair is not among the settings: stages name
  /// theirs.
  trace::Header header() const;

  /// Poses and recorded pairs of one frame, later than the last one that was asked for (0 <= frame,
  /// also beyond the scenario's last). Poses are evaluated in double and rounded to the scalar, and
  /// are written as the pipeline saw them. Pairs are in the scenario's order.
  trace::Frame frame(int frame);

  /// The same pipeline with nothing recorded but the manifolds themselves, in the way a physics
  /// engine would call it: `sat`, `clip` and `reduction` are empty. `separation` is that of the
  /// deepest point, and 0 when separated: how far apart, only a recorded frame says.
  trace::Frame frame_unrecorded(int frame);

 private:
  /// What a pair keeps from one frame for the next.
  template <class S>
  struct Memory {
    std::vector<FeatureId> kept;  // by the reducer, or all
    PairCache<S> cache;
    PersistentManifold<S> persistent;
  };
  /// What chooses pairs, copied with the state; null where all are run.
  struct Chooser {
    std::unique_ptr<BroadPhase> phase;
    std::vector<std::size_t> chosen;  // pairs of the frame before, ascending

    Chooser() = default;
    Chooser(const Chooser& other)
        : phase(other.phase ? other.phase->clone() : nullptr), chosen(other.chosen) {}
    Chooser(Chooser&&) = default;
    Chooser& operator=(Chooser other) {
      phase = std::move(other.phase);
      chosen = std::move(other.chosen);
      return *this;
    }
  };
  /// Before a frame; all that it and the frames after it depend on.
  template <class S>
  struct State {
    std::shared_ptr<const std::vector<Shape<S>>> shapes;  // never changed
    int frame = 0;                                        // the next one
    std::vector<Body<S>> bodies;                          // one a shape; of dynamic scenarios alone
    std::vector<PairImpulses<S>> impulses;                // one a pair, likewise
    std::vector<Memory<S>> memories;                      // one a pair
    Chooser chooser;
  };

  template <class S>
  State<S> at_start() const;
  /// Runs the state's frame and leaves the next one's, recorded into `result` unless that is null: then
  /// only what later frames depend on.
  template <class S>
  void step(State<S>& state, bool recorded, trace::Frame* result) const;
  template <class S>
  trace::Frame run(State<S>& state, int frame, bool recorded) const;
  /// The pairs of this frame, ascending: all, or those whose boxes overlap. What the others kept is
  /// forgotten. Told in `record` unless that is null.
  template <class S>
  std::vector<std::size_t> choose_pairs(State<S>& state, const std::vector<Pose<S>>& poses,
                                        trace::Frame* record) const;
  /// Writes into `record` unless that is null.
  template <class S>
  Manifolds<S> collide_pair(State<S>& state, std::size_t pair, const std::vector<Pose<S>>& poses,
                            trace::Pair* record) const;
  /// Whether a body can rest on the pair's manifolds, where the pair is incremental or a view shows
  /// it: the one that the solver moves, else the higher one along `up`.
  void record_stability(const ScenarioPair& pair, const trace::Frame& frame,
                        trace::Pair& record) const;

  // run_world.cpp: scenarios with dynamic shapes.
  template <class S>
  trace::Solver solver_facts(const State<S>& state) const;
  /// The solver's step, by the contacts of all pairs; what it gave those that were `chosen` stands in
  /// `result` where there is one.
  template <class S>
  void solve(State<S>& state, const std::vector<Manifolds<S>>& contacts,
             const std::vector<std::size_t>& chosen, trace::Frame* result) const;

  const Scenario* scenario_;
  trace::Stages stages_;
  bool shows_stability_;                   // some view
  bool shows_plots_;                       // some view
  bool dynamic_;                           // some shape is moved by the solver
  std::vector<bool> acts_;                 // one a pair: the solver gets its contacts
  std::vector<bool> remembers_;            // one a pair: it goes by the frame before
  std::map<BoxPair, std::size_t> places_;  // of each pair, where a broad phase chooses
  std::variant<State<float>, State<double>> state_;
};

/// A shape of a scenario as a trace has it, with the vertices that the pipeline sees.
template <class S>
trace::Shape traced_shape(const ScenarioShape& shape, const Shape<S>& rounded);

}  // namespace contactscope

#pragma once

#include <mutex>
#include <variant>
#include <vector>

#include "core/feature_id.h"
#include "dynamics/solver.h"
#include "manifold/dispatch.h"
#include "manifold/incremental.h"
#include "scenario/scenario.h"
#include "scenario/snapshots.h"
#include "trace/trace.h"

namespace contactscope {

/// Runs the frames of one scenario. Shapes are rounded to the scenario's scalar once, here. Holds on
/// to the scenario, which must outlive it and keep its shapes; settings of pairs may change between
/// frames. Any frame can be asked for, in any order and on several threads at once, and is the same
/// each time: where a pair goes by what was kept before, as temporal coherence, some reducers and
/// incremental manifolds do, the frames from 0 on are run for it. So they are where shapes are
/// dynamic; states between are kept for frames asked for later. Then a frame shows the bodies before
/// its step, the contacts found there, and what the solver gave them in the step.
class Runner {
 public:
  /// `stages`: the optional stages that recorded frames hold.
  explicit Runner(const Scenario& scenario, const trace::Stages& stages = {});
  explicit Runner(Scenario&&, const trace::Stages& stages = {}) = delete;

  /// The trace's first line: shapes and settings. Vertices are those that the pipeline sees,
  /// rounded to its scalar. A reducer or scalar of a pair is not among the settings: stages name
  /// theirs.
  trace::Header header() const;

  /// Poses and recorded pairs of one frame (0 <= frame, also beyond the last). Poses are evaluated
  /// in double and rounded to the scalar, and are written as the pipeline saw them. Pairs are in
  /// the scenario's order.
  trace::Frame frame(int frame) const;

  /// The same pipeline with nothing recorded but the manifolds themselves, in the way a physics
  /// engine would call it: `sat`, `clip` and `reduction` are empty. `separation` is that of the
  /// deepest point, and 0 when separated: how far apart, only a recorded frame says.
  trace::Frame frame_unrecorded(int frame) const;

 private:
  /// What a pair keeps from one frame for the next.
  struct Memory {
    int frame = -1;
    std::vector<FeatureId> kept;  // by the reducer, as it saw them
    std::variant<PairCache<float>, PairCache<double>> cache;
    std::variant<PersistentManifold<float>, PersistentManifold<double>> persistent;
    PipelineSettings settings;  // that it was kept with
  };

  /// Before the step of a frame; all that the frames from there on depend on.
  template <class S>
  struct WorldState {
    int frame = 0;
    std::vector<Body<S>> bodies;            // one a shape
    std::vector<PairImpulses<S>> impulses;  // one a pair
    std::vector<Memory> memories;           // one a pair
  };
  template <class S>
  using History = Snapshots<WorldState<S>>;

  template <class S>
  trace::Frame run(const std::vector<Shape<S>>& shapes, int frame, bool recorded) const;
  template <class S>
  Manifolds<S> collide_pair(const std::vector<Shape<S>>& shapes, const ScenarioPair& pair,
                            const Pose<S>& pose_a, const Pose<S>& pose_b, int frame, Memory& memory,
                            trace::Pair* record) const;
  /// The facts of a pair that is collided where `frame` has its shapes; adds them to it.
  template <class S>
  Manifolds<S> add_pair(const std::vector<Shape<S>>& shapes, const ScenarioPair& pair,
                        const Pose<S>& pose_a, const Pose<S>& pose_b, bool recorded, Memory& memory,
                        trace::Frame& frame) const;
  template <class S>
  Memory new_memory(const ScenarioPair& pair) const;

  // run_world.cpp: frames of scenarios with dynamic shapes.
  template <class S>
  trace::Frame run_world(const std::vector<Shape<S>>& shapes, int frame, bool recorded) const;
  template <class S>
  WorldState<S> world_at_start(const std::vector<Shape<S>>& shapes) const;
  template <class S>
  WorldState<S> world_before(const std::vector<Shape<S>>& shapes, int frame) const;
  template <class S>
  void solve(WorldState<S>& state, const std::vector<Manifolds<S>>& contacts) const;
  template <class S>
  void put(const WorldState<S>& state) const;
  template <class S>
  History<S>& history() const;
  /// Whether a body can rest on the pair's manifolds, where the pair is incremental or a view shows
  /// it: the one that the solver moves, else the higher one along `up`.
  void record_stability(const ScenarioPair& pair, const trace::Frame& frame,
                        trace::Pair& record) const;
  template <class S>
  Memory memory_before(const std::vector<Shape<S>>& shapes, std::size_t pair, int frame) const;

  const Scenario* scenario_;
  trace::Stages stages_;
  bool shows_stability_;                                                        // some view
  bool shows_plots_;                                                            // some view
  std::variant<std::vector<Shape<float>>, std::vector<Shape<double>>> shapes_;  // one a shape
  mutable std::mutex mutex_;
  /// One a pair, guarded by mutex_: of the frame that ran last, so that the next one need not run
  /// all before it again.
  mutable std::vector<Memory> memories_;

  bool dynamic_;            // some shape is moved by the solver
  std::vector<bool> acts_;  // one a pair: the solver gets its contacts
  // Guarded by mutex_, of dynamic scenarios alone.
  mutable std::variant<History<float>, History<double>> history_;
  mutable std::vector<PipelineSettings> history_settings_;  // of the pairs when it was made
};

/// For one call; whoever runs a sequence keeps a Runner.
trace::Header trace_header(const Scenario& scenario);
trace::Frame run_frame(const Scenario& scenario, int frame);
trace::Frame run_frame_unrecorded(const Scenario& scenario, int frame);

}  // namespace contactscope

#pragma once

#include <vector>

#include "broadphase/broad_phase.h"
#include "dynamics/solver.h"
#include "manifold/dispatch.h"
#include "manifold/incremental.h"
#include "query/mesh_overlap.h"
#include "query/mesh_query_cost.h"
#include "scenario/scenario.h"

/// A pair that is run, with its settings and state.
namespace contactscope {

inline CollideOptions options_of(const PipelineSettings& settings) {
  CollideOptions options;
  options.margin = settings.margin;
  options.preference = settings.preference;
  options.degenerate = settings.degenerate;
  options.field = settings.field;
  options.internal_edges = settings.internal_edges;
  options.mesh_manifolds = settings.mesh_manifolds;
  options.penetration = settings.penetration;
  options.reducer = find_reducer(settings.reducer);
  options.reduction.max_points = settings.max_points;
  return options;
}

/// Whether its tree is rebuilt when it has become expensive.
inline bool chooses_tree(const ScenarioShape& shape) {
  return shape.deforms() && shape.tree == TreeUpdate::Auto;
}

/// Whether a pair uses results of the previous frame, or reports to a mesh what its tree cost.
inline bool remembers(const Scenario& scenario, const ScenarioPair& pair) {
  const PipelineSettings& settings = pair.pipeline;
  if (!settings.makes_contacts())
    return starts_somewhere(scenario, pair) &&
           (settings.traversal == Traversal::Coherent || chooses_tree(scenario.shape(pair.a)) ||
            chooses_tree(scenario.shape(pair.b)));
  const auto kind = [&](int i) { return kind_of(*scenario.shape(i).geometry); };
  const ReducerInfo* const reducer = find_reducer(settings.reducer);
  return settings.manifold == ManifoldKind::Incremental ||
         (settings.cache && can_cache(kind(pair.a), kind(pair.b))) ||
         (reducer != nullptr && reducer->remembers);
}

/// Initial state of a shape's body.
template <class S> Body<S> body_of(const ScenarioShape& shape, const Shape<S>& rounded) {
  const Pose<S> pose = collider_pose_at(shape, 0).template cast<S>();
  if (!shape.dynamic()) return static_body<S>(pose);
  Body<S> body = dynamic_body<S>(pose, with_mass(*mass_properties(rounded), shape.body->mass));
  body.velocity = shape.body->velocity.template cast<S>();
  body.angular_velocity = shape.body->angular_velocity.template cast<S>();
  return body;
}

/// A pair that is run, and its state from frame to frame.
template <class S> struct ActivePair {
  ScenarioPair pair;
  bool acts = false;            // the solver gets its contacts
  bool touches = false;         // it had contact points at its last collision
  std::vector<FeatureId> kept;  // kept by the reducer, or all
  PairCache<S> cache;
  std::vector<PersistentManifold<S>> persistent;  // zero or one (5 kB), for incremental manifolds
  PairImpulses<S> impulses;                       // dynamic scenarios only
  QueryMemory query;
  MeshQueryCost query_cost;  // of two meshes

  BoxPair shapes() const { return {pair.a, pair.b}; }
};

}  // namespace contactscope

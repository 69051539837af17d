#pragma once

#include "broadphase/broad_phase.h"
#include "dynamics/solver.h"
#include "manifold/incremental.h"
#include "query/mesh_query_cost.h"
#include "scenario/scenario.h"

/// Meshes and pairs that are run, with their settings and state.
namespace contactscope {

/// A mesh with motion.deform, in the pipeline's scalar. An automatic tree needs earlier frames.
template <class S> class DeformingMesh {
 public:
  /// At time 0, with a new tree. `shape` has a deformation and must outlive this.
  DeformingMesh(int index, const ScenarioShape& shape)
      : index_(index), scripted_(&shape), shape_(shape_cast<S>(*shape.collider)) {
    deform(0);
    update_tree(mesh(), TreeUpdate::Rebuild, cost_when_built_);
  }

  int index() const { return index_; }  // in the scenario's shapes
  const Shape<S>& shape() const { return shape_; }

  /// Updates vertices, normals and tree; returns whether it was rebuilt: an automatic tree is if
  /// queries of the previous frame found it worse, or without a verdict by its surface areas.
  bool move_to(double time) {
    if (std::exchange(is_new_, false) && time == 0) return false;
    deform(time);
    const Verdict verdict = std::exchange(verdict_, Verdict::Unknown);
    const bool rebuilt = update_tree(mesh(), MeshQueryCost::update_after(verdict, scripted_->tree),
                                     cost_when_built_);
    tree_ = rebuilt ? "rebuilt" : "refitted";
    return rebuilt;
  }

  /// Reports a query's verdict on the tree. The worst one counts.
  void was_queried(MeshQueryCost::Verdict verdict) { verdict_ = std::max(verdict_, verdict); }

  trace::Deformed facts() const {
    const Mesh<S>& now = std::get<Mesh<S>>(shape_);
    trace::Deformed record{scripted_->name,
                           scripted_->is_moved() ? exact_ : cast_each<Vec3d>(now.vertices), tree_,
                           now.tree.expected_cost(), cost_when_built_};
    report_boxes(now.tree, 0, 0, record.boxes);
    return record;
  }

 private:
  using Verdict = MeshQueryCost::Verdict;

  // Boxes recorded: at this level below the root, and leaves above it. At most sixteen.
  static constexpr int kRecordedLevel = 4;

  void report_boxes(const AabbTree<S>& tree, int node, int level,
                    std::vector<trace::Box>& boxes) const {
    if (level < kRecordedLevel && !at(tree.nodes, node).leaf()) {
      report_boxes(tree, node + 1, level + 1, boxes);
      report_boxes(tree, tree.right_of(node), level + 1, boxes);
      return;
    }
    const Aabb<double> box = at(tree.nodes, node).box.template cast<double>();
    const Vec3d& origin = scripted_->collider_origin;
    boxes.push_back({box.lower + origin, box.upper + origin});
  }

  Mesh<S>& mesh() { return std::get<Mesh<S>>(shape_); }

  void deform(double time) {
    const auto& at_rest = std::get<Mesh<double>>(*scripted_->geometry).vertices;
    std::vector<Vec3d> moved = deformed_vertices(*scripted_->motion.deformation, at_rest, time);
    const Vec3d& origin = scripted_->collider_origin;
    mesh().vertices =
        mapped(moved, [&](const Vec3d& x) -> Vec3<S> { return (x - origin).template cast<S>(); });
    update_surface(mesh());
    if (scripted_->is_moved()) exact_ = std::move(moved);
  }

  int index_;
  const ScenarioShape* scripted_;
  Shape<S> shape_;
  std::vector<Vec3d> exact_;  // for a moved shape: vertices before rounding
  double cost_when_built_ = 0;
  const char* tree_ = "built";
  Verdict verdict_ = Verdict::Unknown;  // of queries since the last move
  bool is_new_ = true;                  // not moved yet
};

inline CollideOptions options_of(const PipelineSettings& settings) {
  CollideOptions options;
  options.margin = settings.margin;
  options.preference = settings.preference;
  options.degenerate = settings.degenerate;
  options.field = settings.field;
  options.internal_edges = settings.internal_edges;
  options.mesh_manifolds = settings.mesh_manifolds;
  options.recorded_triangle = settings.triangle;
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

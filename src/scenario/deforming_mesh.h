#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "query/mesh_query_cost.h"
#include "scenario/scenario.h"
#include "trace/trace.h"

namespace contactscope {

/// A mesh with motion.deform, rounded to the pipeline's scalar. If the tree decides itself when to
/// be rebuilt, it depends on earlier frames.
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

  /// Updates vertices, normals and tree. An automatic tree is rebuilt if queries of the previous
  /// frame found it worse; without a verdict, its surface areas decide. Returns whether it was
  /// rebuilt.
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

  // Boxes at this level below the root, and leaves above it, are recorded: sixteen at most, as many
  // as a picture has room for.
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

}  // namespace contactscope

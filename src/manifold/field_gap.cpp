#include "manifold/field_gap.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/at.h"
#include "query/gjk.h"

namespace contactscope {
namespace {

/// A piece in the lattice's frame, cells.
struct Core {
  std::array<Vec3d, 3> corners;
  int count;
  FeatureRef feature;
  Aabb<double> box;

  SupportSet<double> set() const { return {corners.data(), count, nullptr}; }
};

Core core_of(const PlacedField& field, const FieldPiece& piece) {
  Core core{{}, piece.count, piece.feature, {}};
  for (int k = 0; k < piece.count; ++k) {
    at(core.corners, k) = field.in_lattice(at(piece.corners, k));
    core.box.include(at(core.corners, k));
  }
  return core;
}

double distance_of(const Aabb<double>& a, const Aabb<double>& b) {
  return (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(0.0).norm();
}

/// Lengths in cells.
class GapSearch {
 public:
  GapSearch(const DistanceField& field, double best) : field_(field), best_(best) {}

  void look_at(const Core& core) {
    if (const auto& round = field_.core()) {
      offer(core, {round->points.data(), 2, nullptr}, round->radius);
    } else {
      look_at(core, *field_.surface());
    }
  }
  double best() const { return best_; }
  /// Feature of the best; null if nothing is nearer than the limit.
  const FeatureRef* feature() const { return core_ ? &core_->feature : nullptr; }
  const Vec3d& on_core() const { return on_core_; }
  const Vec3d& outward() const { return outward_; }

 private:
  void offer(const Core& core, const SupportSet<double>& other, double radius) {
    const GjkResult<double> nearest = gjk<double>(core.set(), other, Pose<double>{});
    const double distance = std::max(nearest.distance - radius, 0.0);
    if (!(distance < best_)) return;
    best_ = distance;
    core_ = core;
    on_core_ = nearest.on_a;
    outward_ = -nearest.normal;
  }

  void look_at(const Core& core, const Mesh<double>& surface) {
    const AabbTree<double>& tree = surface.tree;
    using Waiting = std::pair<double, int>;  // distance of the box, node
    std::array<Waiting, kMaxAabbTreeDepth + 1> stack;
    int height = 0;
    at(stack, height++) = {distance_of(core.box, tree.bounds()), 0};
    while (height > 0) {
      const auto [near, index] = at(stack, --height);
      if (near >= best_) continue;
      const AabbTree<double>::Node& node = at(tree.nodes, index);
      if (node.leaf()) {
        for (int k = node.next; k < node.next + node.count; ++k) {
          if (!(distance_of(core.box, at(tree.boxes, k)) < best_)) continue;
          const int triangle = at(tree.triangles, k);
          const std::array<Vec3d, 3> corners = {surface.corner(triangle, 0),
                                                surface.corner(triangle, 1),
                                                surface.corner(triangle, 2)};
          offer(core, {corners.data(), 3, nullptr}, 0);
        }
        continue;
      }
      Waiting left{0, index + 1}, right{0, tree.right_of(index)};
      for (Waiting* child : {&left, &right})
        child->first = distance_of(core.box, at(tree.nodes, child->second).box);
      at(stack, height++) = std::max(left, right);
      at(stack, height++) = std::min(left, right);
    }
  }

  const DistanceField& field_;
  double best_;
  std::optional<Core> core_;
  Vec3d on_core_ = Vec3d::Zero(), outward_ = Vec3d::UnitY();
};

}  // namespace

FieldGap field_gap(const PlacedField& field, std::span<const FieldPiece> pieces, double limit) {
  GapSearch search(*field.field, limit * field.per_cell);
  for (const FieldPiece& piece : pieces) search.look_at(core_of(field, piece));
  if (search.feature() == nullptr) return {limit};
  return {search.best() * field.cell, field.origin + field.cell * search.on_core(),
          search.outward(), *search.feature()};
}

}  // namespace contactscope

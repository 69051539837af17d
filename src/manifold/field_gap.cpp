#include "manifold/field_gap.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/at.h"
#include "query/gjk.h"

namespace contactscope {
namespace {

/// A piece in the lattice's frame, cells.
struct Core {
  std::array<Vec3d, 3> corners;
  int count;
  Aabb<double> box;

  SupportSet<double> set() const { return {corners.data(), count, nullptr}; }
};

Core core_of(const PlacedField& field, const FieldPiece& piece) {
  Core core{{}, piece.count, {}};
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
      const SupportSet<double> axis{round->points.data(), 2, nullptr};
      best_ = std::min(best_, std::max(distance(core, axis) - round->radius, 0.0));
    } else {
      look_at(core, *field_.surface());
    }
  }
  double best() const { return best_; }

 private:
  static double distance(const Core& core, const SupportSet<double>& other) {
    return gjk<double>(core.set(), other, Pose<double>{}).distance;
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
        for (int k = node.next; k < node.next + node.count; ++k)
          if (distance_of(core.box, at(tree.boxes, k)) < best_)
            best_ = std::min(best_, distance_to(core, surface, at(tree.triangles, k)));
        continue;
      }
      Waiting left{0, index + 1}, right{0, tree.right_of(index)};
      for (Waiting* child : {&left, &right})
        child->first = distance_of(core.box, at(tree.nodes, child->second).box);
      at(stack, height++) = std::max(left, right);
      at(stack, height++) = std::min(left, right);
    }
  }

  static double distance_to(const Core& core, const Mesh<double>& surface, int triangle) {
    const std::array<Vec3d, 3> corners = {surface.corner(triangle, 0), surface.corner(triangle, 1),
                                          surface.corner(triangle, 2)};
    return distance(core, {corners.data(), 3, nullptr});
  }

  const DistanceField& field_;
  double best_;
};

}  // namespace

double field_gap(const PlacedField& field, std::span<const FieldPiece> pieces, double radius,
                 double limit) {
  if (pieces.empty()) return std::numeric_limits<double>::infinity();
  GapSearch search(*field.field, (limit + radius) * field.per_cell);
  for (const FieldPiece& piece : pieces) search.look_at(core_of(field, piece));
  return std::max(search.best() * field.cell - radius, 0.0);
}

}  // namespace contactscope

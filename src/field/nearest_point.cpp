#include "field/nearest_point.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/at.h"

namespace contactscope {
namespace {

using Pack = lanes::Pack<float>;

/// x, y and z, and 0.
Pack pack_of_point(const Vec3d& point) {
  return Pack{static_cast<float>(point.x()), static_cast<float>(point.y()),
              static_cast<float>(point.z()), 0};
}

/// The squared distance from a box that was rounded outwards.
[[gnu::always_inline]] inline float squared_distance(const Pack& lower, const Pack& upper,
                                                     const Pack& point) {
  const Pack beyond = lanes::larger(lanes::larger(lower - point, point - upper), Pack{});
  const Pack squares = beyond * beyond;
  return (squares[0] + squares[1]) + squares[2];
}

/// What rounding a point and a box to float, and the arithmetic above, may add to a distance, as a part
/// of the largest number there.
constexpr double kRoughness = 0x1p-20;

}  // namespace

NearestTriangles::NearestTriangles(std::shared_ptr<const Mesh<double>> mesh)
    : mesh_(std::move(mesh)), prisms_(mesh_->triangles.size()) {
  for (int t = 0; t < mesh_->triangle_count(); ++t) {
    Prism& prism = at(prisms_, t);
    prism.normal = mesh_->normal(t);
    for (std::size_t k = 0; k < 3; ++k) {
      prism.corners[k] = mesh_->corner(t, static_cast<int>(k));
      prism.edges[k] = mesh_->corner(t, static_cast<int>((k + 1) % 3)) - prism.corners[k];
      prism.inward[k] = prism.normal.cross(prism.edges[k]);
      const double length = prism.edges[k].squaredNorm();
      prism.edge_scale[k] = length > 0 ? 1 / length : 0;
    }
  }
  const Aabb<double> all = mesh_->tree.bounds();
  const double largest = all.lower.cwiseAbs().cwiseMax(all.upper.cwiseAbs()).maxCoeff();
  const Vec3d out = Vec3d::Constant(kRoughness * largest);
  const auto rough = [&](const Aabb<double>& box) {
    return RoughBox{pack_of_point(box.lower - out), pack_of_point(box.upper + out)};
  };
  node_boxes_ = mapped(mesh_->tree.nodes, [&](const auto& node) { return rough(node.box); });
  triangle_boxes_ = mapped(mesh_->tree.boxes, rough);
}

NearestPoint NearestTriangles::nearest(const Vec3d& point, std::span<const int> seeds) const {
  const AabbTree<double>& tree = mesh_->tree;
  NearestPoint best = nearest_of(seeds, point);
  struct Waiting {
    int node;
    float squared;
  };
  std::array<Waiting, kMaxAabbTreeDepth> stack;
  std::size_t height = 0;
  const Pack at_point = pack_of_point(point);
  // More than the square by what far points are rounded.
  const auto rounded_up = [&] { return static_cast<float>(best.squared * (1 + kRoughness)); };
  const auto distance_to = [&](const std::vector<RoughBox>& boxes, int i) {
    const RoughBox& box = at(boxes, i);
    return squared_distance(box.lower, box.upper, at_point);
  };
  float least = rounded_up();
  int i = 0;
  while (true) {
    const AabbTree<double>::Node& node = at(tree.nodes, i);
    if (node.leaf()) {
      for (int k = node.next; k < node.next + node.count; ++k) {
        if (distance_to(triangle_boxes_, k) > least) continue;
        improve(at(tree.triangles, k), point, best);
        least = rounded_up();
      }
    } else {
      Waiting near{i + 1, distance_to(node_boxes_, i + 1)};
      const int right = tree.right_of(i);
      Waiting far{right, distance_to(node_boxes_, right)};
      if (far.squared < near.squared) std::swap(near, far);
      if (far.squared <= least) stack[height++] = far;
      if (near.squared <= least) {
        i = near.node;
        continue;
      }
    }
    while (height > 0 && stack[height - 1].squared > least) --height;
    if (height == 0) return best;
    i = stack[--height].node;
  }
}

void NearestTriangles::around(const Vec3d& middle, double half_side, const NearestPoint& nearest,
                              std::vector<int>& found) const {
  const AabbTree<double>& tree = mesh_->tree;
  const Pack at_middle = pack_of_point(middle), at_nearest = pack_of_point(nearest.point);
  const double diagonal = 2 * 1.7320508075688774 * half_side;
  const double by_distance = std::sqrt(nearest.squared) + diagonal;
  const auto most = static_cast<float>(by_distance * by_distance * (1 + kRoughness));
  const auto base = static_cast<float>(nearest.squared * (1 + kRoughness));
  const auto rise = static_cast<float>(2 * half_side * (1 + kRoughness));
  const auto can_be = [&](const RoughBox& box) {
    const Pack below = box.lower - at_nearest, above = box.upper - at_nearest;
    const Pack sides = lanes::larger(lanes::larger(below, -below), lanes::larger(above, -above));
    const float farthest = (sides[0] + sides[1]) + sides[2];
    return squared_distance(box.lower, box.upper, at_middle) <=
           std::min(most, base + rise * farthest);
  };
  const int node_count = count_of(tree.nodes);
  int i = 0;
  while (i < node_count) {
    const AabbTree<double>::Node& node = at(tree.nodes, i);
    const bool hit = can_be(at(node_boxes_, i));
    if (hit && node.leaf()) {
      for (int k = node.next; k < node.next + node.count; ++k)
        if (can_be(at(triangle_boxes_, k))) found.push_back(at(tree.triangles, k));
    }
    i = hit || node.leaf() ? i + 1 : node.next;
  }
}

std::size_t NearestTriangles::bytes() const {
  return prisms_.size() * (sizeof(Prism) + sizeof(RoughBox) + sizeof(Aabb<double>) + sizeof(int)) +
         mesh_->tree.nodes.size() * (sizeof(AabbTree<double>::Node) + sizeof(RoughBox));
}

}  // namespace contactscope

#include "field/nearest_point.h"

#include <algorithm>
#include <utility>

#include "core/at.h"

namespace contactscope {
namespace {

[[gnu::always_inline]] inline double squared_distance(const Aabb<double>& box, const Vec3d& point) {
  const Vec3d beyond = (box.lower - point).cwiseMax(point - box.upper).cwiseMax(0.0);
  return beyond.squaredNorm();
}

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
}

NearestPoint NearestTriangles::nearest(const Vec3d& point, int seed) const {
  const AabbTree<double>& tree = mesh_->tree;
  NearestPoint best;
  if (seed >= 0) improve(seed, point, best);
  struct Waiting {
    int node;
    double squared;
  };
  std::array<Waiting, kMaxAabbTreeDepth> stack;
  std::size_t height = 0;
  int i = 0;
  while (true) {
    const AabbTree<double>::Node& node = at(tree.nodes, i);
    if (node.leaf()) {
      for (int k = node.next; k < node.next + node.count; ++k)
        if (squared_distance(at(tree.boxes, k), point) < best.squared)
          improve(at(tree.triangles, k), point, best);
    } else {
      Waiting near{i + 1, squared_distance(at(tree.nodes, i + 1).box, point)};
      const int right = tree.right_of(i);
      Waiting far{right, squared_distance(at(tree.nodes, right).box, point)};
      if (far.squared < near.squared) std::swap(near, far);
      if (far.squared < best.squared) stack[height++] = far;
      if (near.squared < best.squared) {
        i = near.node;
        continue;
      }
    }
    while (height > 0 && stack[height - 1].squared >= best.squared) --height;
    if (height == 0) return best;
    i = stack[--height].node;
  }
}

void NearestTriangles::within(const Vec3d& point, double squared, std::vector<int>& found) const {
  const AabbTree<double>& tree = mesh_->tree;
  const int node_count = count_of(tree.nodes);
  int i = 0;
  while (i < node_count) {
    const AabbTree<double>::Node& node = at(tree.nodes, i);
    const bool hit = squared_distance(node.box, point) <= squared;
    if (hit && node.leaf()) {
      for (int k = node.next; k < node.next + node.count; ++k) {
        if (squared_distance(at(tree.boxes, k), point) > squared) continue;
        NearestPoint own;
        improve(at(tree.triangles, k), point, own);
        if (own.squared <= squared) found.push_back(at(tree.triangles, k));
      }
    }
    i = hit || node.leaf() ? i + 1 : node.next;
  }
}

std::size_t NearestTriangles::bytes() const {
  return prisms_.size() * (sizeof(Prism) + sizeof(Aabb<double>) + sizeof(int)) +
         mesh_->tree.nodes.size() * sizeof(AabbTree<double>::Node);
}

}  // namespace contactscope

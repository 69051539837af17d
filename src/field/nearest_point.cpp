#include "field/nearest_point.h"

namespace contactscope {
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
  NearestPoint best = nearest_of(seeds, point);
  const Floats at_point = pack_of_point(point);
  search(point, best, [&](int, int first, int count) {
    for (int k = first; k < first + count; ++k)
      if (at(triangle_boxes_, k).squared_distance(at_point) <= rounded_up(best.squared))
        improve(at(mesh_->tree.triangles, k), point, best);
  });
  return best;
}

std::size_t NearestTriangles::bytes() const {
  return prisms_.size() * (sizeof(Prism) + sizeof(RoughBox) + sizeof(Aabb<double>) + sizeof(int)) +
         mesh_->tree.nodes.size() * (sizeof(AabbTree<double>::Node) + sizeof(RoughBox));
}

}  // namespace contactscope

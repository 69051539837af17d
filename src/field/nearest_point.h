#pragma once

#include "geometry/mesh.h"

namespace contactscope {

struct NearestPoint {
  Vec3d point = Vec3d::Zero();                               // on the surface, its frame and unit
  double squared = std::numeric_limits<double>::infinity();  // distance, squared
  int triangle = -1;
  bool on_face = false;  // inside the triangle, not on its outline
};

/// Triangles of a mesh, laid out for nearest-point queries; same frame and unit.
///
/// Inside the prism over a triangle the nearest point is on its plane; the mesh's unit normal is
/// exact to a few roundings, for slivers too. Outside it is on one of the edges that the point is
/// beyond. Ericson 2005, "Real-Time Collision Detection", 5.1.5, finds the regions by barycentric
/// coordinates, which floating point cannot compute for slivers.
class NearestTriangles {
 public:
  NearestTriangles() = default;
  explicit NearestTriangles(std::shared_ptr<const Mesh<double>> mesh);
  const Mesh<double>& mesh() const { return *mesh_; }

  /// The nearest of all triangles; ties are arbitrary. Nearby `seeds` shorten the search.
  NearestPoint nearest(const Vec3d& point, std::span<const int> seeds = {}) const;

  /// Searches the tree for the triangles nearest to a point, near branches first, up to `best`.
  /// visit(leaf, first, count) checks triangles from `first` on, and may replace `best`.
  template <class Visit>
  void search(const Vec3d& point, NearestPoint& best, const Visit& visit) const;

  /// The nearest of a list.
  NearestPoint nearest_of(std::span<const int> triangles, const Vec3d& point) const {
    NearestPoint best;
    for (const int triangle : triangles) improve(triangle, point, best);
    return best;
  }

  /// Calls visit(leaf, first, count) for all leaves that have triangles that can be nearest to a
  /// point of a cube, and some others. `near`: a point of the surface. See TriangleSieve.
  template <class Visit>
  void around(const Vec3d& middle, double half_side, const Vec3d& near, const Visit& visit) const;

  /// Signed distance of a point from a triangle's plane: positive in front.
  double height_over(int triangle, const Vec3d& point) const {
    const Prism& prism = at(prisms_, triangle);
    return prism.normal.dot(point - prism.corners[0]);
  }
  const Vec3d& normal(int triangle) const { return at(prisms_, triangle).normal; }
  /// Replaces `best` if the triangle is nearer.
  void improve(int triangle, const Vec3d& point, NearestPoint& best) const {
    const Prism& prism = at(prisms_, triangle);
    const Vec3d from = point - prism.corners[0];
    const double height = prism.normal.dot(from);
    if (height * height >= best.squared) return;
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d from_k = point - prism.corners[k];
      if (prism.inward[k].dot(from_k) >= 0) continue;
      inside = false;
      double along = prism.edges[k].dot(from_k) * prism.edge_scale[k];
      along = along < 0 ? 0 : (along > 1 ? 1 : along);
      const Vec3d offset = from_k - along * prism.edges[k];
      const double squared = offset.squaredNorm();
      if (squared < best.squared) best = {point - offset, squared, triangle, false};
    }
    if (inside) best = {point - height * prism.normal, height * height, triangle, true};
  }

  std::size_t bytes() const;

 private:
  struct Prism {
    Vec3d normal;  // next to the first corner in memory: most triangles need only these
    std::array<Vec3d, 3> corners, edges;
    std::array<Vec3d, 3> inward;       // in the plane, perpendicular to the edge
    std::array<double, 3> edge_scale;  // 1 / |edge|^2
  };
  using Floats = lanes::Pack<float>;
  /// A box in single precision, enlarged by its rounding.
  struct RoughBox {
    Floats lower, upper;

    [[gnu::always_inline]] float squared_distance(const Floats& point) const {
      const Floats beyond = lanes::larger(lanes::larger(lower - point, point - upper), Floats{});
      const Floats squares = beyond * beyond;
      return (squares[0] + squares[1]) + squares[2];
    }
  };
  /// {x, y, z, 0}.
  static Floats pack_of_point(const Vec3d& point) {
    return Floats{static_cast<float>(point.x()), static_cast<float>(point.y()),
                  static_cast<float>(point.z()), 0};
  }
  /// Bound on the rounding of a point, a box and their distance in float, relative to the largest.
  static constexpr double kRoughness = 0x1p-20;
  /// The square, enlarged by the rounding of far points.
  static float rounded_up(double squared) { return static_cast<float>(squared * (1 + kRoughness)); }

  std::shared_ptr<const Mesh<double>> mesh_;
  std::vector<Prism> prisms_;
  std::vector<RoughBox> node_boxes_, triangle_boxes_;  // in the order of the tree
};

template <class Visit>
void NearestTriangles::around(const Vec3d& middle, double half_side, const Vec3d& near,
                              const Visit& visit) const {
  const AabbTree<double>& tree = mesh_->tree;
  const Floats at_middle = pack_of_point(middle), at_near = pack_of_point(near);
  const double squared = (middle - near).squaredNorm();
  const double diagonal = 2 * 1.7320508075688774 * half_side;
  const double by_distance = std::sqrt(squared) + diagonal;
  const auto most = static_cast<float>(by_distance * by_distance * (1 + kRoughness));
  const auto base = static_cast<float>(squared * (1 + kRoughness));
  const auto rise = static_cast<float>(2 * half_side * (1 + kRoughness));
  const int node_count = count_of(tree.nodes);
  int i = 0;
  while (i < node_count) {
    const AabbTree<double>::Node& node = at(tree.nodes, i);
    const RoughBox& box = at(node_boxes_, i);
    const Floats below = box.lower - at_near, above = box.upper - at_near;
    const Floats sides = lanes::larger(lanes::larger(below, -below), lanes::larger(above, -above));
    const float farthest = (sides[0] + sides[1]) + sides[2];
    const bool hit = box.squared_distance(at_middle) <= std::min(most, base + rise * farthest);
    if (hit && node.leaf()) visit(i, node.next, node.count);
    i = hit || node.leaf() ? i + 1 : node.next;
  }
}

template <class Visit>
void NearestTriangles::search(const Vec3d& point, NearestPoint& best, const Visit& visit) const {
  const AabbTree<double>& tree = mesh_->tree;
  struct Waiting {
    int node;
    float squared;
  };
  std::array<Waiting, kMaxAabbTreeDepth> stack;
  std::size_t height = 0;
  const Floats at_point = pack_of_point(point);
  float least = rounded_up(best.squared);
  int i = 0;
  while (true) {
    const AabbTree<double>::Node& node = at(tree.nodes, i);
    if (node.leaf()) {
      visit(i, node.next, node.count);
      least = rounded_up(best.squared);
    } else {
      Waiting near{i + 1, at(node_boxes_, i + 1).squared_distance(at_point)};
      const int right = tree.right_of(i);
      Waiting far{right, at(node_boxes_, right).squared_distance(at_point)};
      if (far.squared < near.squared) std::swap(near, far);
      if (far.squared <= least) stack[height++] = far;
      if (near.squared <= least) {
        i = near.node;
        continue;
      }
    }
    while (height > 0 && stack[height - 1].squared > least) --height;
    if (height == 0) return;
    i = stack[--height].node;
  }
}

}  // namespace contactscope

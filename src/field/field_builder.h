#pragma once

#include "field/distance_field.h"

namespace contactscope {

/// Fills a DistanceField in the order of the steps of build_distance_field().
class FieldBuilder {
 public:
  /// A surface without holes in the frame of the lattice; `watertight`: no hole had to be closed.
  FieldBuilder(std::shared_ptr<const Mesh<double>> surface, bool watertight, const Vec3d& size,
               const FieldSettings& settings);
  FieldBuilder(const Capsule<double>& core, const Vec3d& size, const FieldSettings& settings);

  DistanceField build();

 private:
  using Node = DistanceField::Node;

  void check_bytes(double fine_blocks) const;
  void fill_coarse();
  void sign_coarse();
  void choose_blocks();
  void fill_block(int fine);
  void find_triangles(const Vec3d& corner, const Node* nodes);

  /// Nearest point of the surface: its distance, and the gradient as if the point were outside.
  Node unsigned_node(const Vec3d& point, int& seed) const;
  bool is_inside(const Vec3d& point);
  static void turn_inside(Node& node) { node = -node; }

  int block_number(int x, int y, int z) const {
    return (z * field_.blocks_[1] + y) * field_.blocks_[0] + x;
  }
  std::array<int, 3> block_at(int number) const {
    const int x = number % field_.blocks_[0], rest = number / field_.blocks_[0];
    return {x, rest % field_.blocks_[1], rest / field_.blocks_[1]};
  }
  Node& coarse_node(int x, int y, int z) {
    return at(field_.coarse_, (z * (field_.blocks_[1] + 1) + y) * (field_.blocks_[0] + 1) + x);
  }
  Node* fine_nodes(int fine) {
    return field_.fine_.data() + static_cast<std::ptrdiff_t>(fine) * DistanceField::kNodes;
  }

  DistanceField field_;
  std::vector<int> blocks_;  // that have fine nodes, by number
  bool one_front_ = true;    // no point was found around which the surface goes in two ways
  int winding_ = 0;          // around points inside; 0: none was asked yet
};

}  // namespace contactscope

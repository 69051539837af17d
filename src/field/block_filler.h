#pragma once

#include "field/field_builder.h"

namespace contactscope {

enum class NodeSign : std::uint8_t { Unknown, Outside, Inside };

/// Gives each node of a lattice the sign of a neighbour, along axes or diagonals, if no surface can
/// separate them: the sum of their distances exceeds the distance between them, `side` cells along
/// an axis. If no known node qualifies, `is_inside` decides one unknown node.
///
/// `counts` of nodes along x, y, z; unsigned distances of `nodes`, x first; some `signs` are known.
void spread_signs(const std::array<int, 3>& counts, double side,
                  std::span<const lanes::Pack<float>> nodes, std::span<NodeSign> signs,
                  const std::function<bool(int x, int y, int z)>& is_inside);

/// Bound on the rounding of the sum of two nodes' distances, cells.
inline constexpr double kSignSlack = 0x1p-12;

/// Fills blocks of a field, one after the other. One per thread.
class BlockFiller {
 public:
  explicit BlockFiller(FieldBuilder& shared)
      : shared_(shared), field_(shared.field_), sieve_(shared.sieve_ ? &*shared.sieve_ : nullptr) {}

  /// Fills the nodes of a block, and appends the triangles of its cells to its layer.
  void fill(int fine, FieldBuilder::Layer& layer);
  /// Marks surface cells that are not smooth: their samples query their triangles.
  void query_triangles(int fine);

 private:
  using Node = FieldBuilder::Node;
  static constexpr int kBlock = DistanceField::kBlock;
  static constexpr int kSide = DistanceField::kSide;
  static constexpr int kNodes = DistanceField::kNodes;
  static constexpr int kCells = DistanceField::kCells;
  static constexpr double kHalfCell = FieldBuilder::kHalfCell;

  void copy_known(int fine);
  void fill_by_core();
  void fill_by_triangles(const FieldBuilder::NearBlock& near);
  void fill_part(const std::array<int, 3>& part);
  TriangleSieve::List& triangles_of_part();
  void fill_nodes(const std::array<int, 3>& group);
  void compare_sides(FieldBuilder::Fronts& fronts) const;
  bool may_have_surface(const std::array<int, 3>& cell) const;
  void find_triangles(const std::array<int, 3>& cell);
  bool is_smooth(const Vec3d& corner, const NodePair* first, std::span<const int> triangles);
  bool blends_well(const Vec3d& corner, const NodePair* first) const;

  NodePair* pairs_of(int fine) const {
    return &at(field_.nodes_, field_.coarse_count_ + fine * DistanceField::kPairs);
  }
  static constexpr int node_in_block(int i, int j, int k) { return (k * kSide + j) * kSide + i; }

  FieldBuilder& shared_;
  DistanceField& field_;
  const TriangleSieve* sieve_;  // null for a core
  TriangleSieve::List of_block_, of_part_, of_group_, of_cell_;
  // For the current block:
  std::vector<NodePair*> querying_;
  Vec3d corner_ = Vec3d::Zero();
  std::span<Node> nodes_;  // without signs until all are known
  std::array<NodeSign, kNodes> signs_{};
  std::array<bool, kNodes> known_{};
  std::array<signed char, kNodes> side_{};  // 1: in front of the nearest face, -1: behind it
  std::array<std::vector<int>, kCells> triangles_;
  Vec3d last_ = Vec3d::Zero();  // surface point nearest to the last node
  Vec3d part_middle_ = Vec3d::Zero();
  bool part_sifted_ = false;  // whether of_part_ belongs to the current part
};

}  // namespace contactscope

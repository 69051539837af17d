#pragma once

#include "field/distance_field.h"
#include "field/node_signs.h"
#include "field/triangle_sieve.h"

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
  static constexpr int kBlock = DistanceField::kBlock;
  static constexpr int kSide = DistanceField::kSide;
  static constexpr int kNodes = DistanceField::kNodes;
  static constexpr int kCells = DistanceField::kCells;
  // Half the diagonal of a cell and of a block, rounded up.
  static constexpr double kHalfCell = 0.8660254037844388;
  static constexpr double kHalfBlock = kBlock * kHalfCell;

  /// Distance, then its gradient.
  using Node = lanes::Pack<float>;
  /// A block while it is filled.
  struct Block {
    int fine;  // its number
    Vec3d corner;
    std::span<Node> nodes;  // without signs, until all are known
    std::array<NodeSign, kNodes> signs{};
    std::array<bool, kNodes> known{};
    std::array<signed char, kNodes>
        side{};  // 1: in front of the face that is nearest, -1: behind it
    std::array<std::vector<int>, kCells> triangles;
  };

  void check_bytes(double fine_blocks) const;
  void fill_coarse();
  void sign_coarse();
  void choose_blocks();
  void lay_out();
  void fill_block(Block& block);
  void copy_known(Block& block);
  void fill_by_core(Block& block);
  void fill_by_triangles(Block& block);
  void fill_nodes(Block& block, const std::array<int, 3>& group);
  void compare_sides(const Block& block);
  void find_triangles_of_part(Block& block, const std::array<int, 3>& first);
  static bool may_have_surface(const Block& block, const std::array<int, 3>& cell);
  void find_triangles(Block& block, const std::array<int, 3>& cell);
  void ask_triangles();
  bool is_smooth(const Vec3d& corner, std::span<const int> triangles);
  bool blends_well(const Vec3d& corner);

  /// Nearest point of the surface: its distance, and the gradient as if the point were outside.
  Node unsigned_node(const Vec3d& point, const NearestPoint& nearest) const;
  Node unsigned_node_of_core(const Vec3d& point) const;
  bool is_inside(const Vec3d& point);

  /// Appends pairs of the nodes of each row, rounded. A row has `row` nodes.
  void add_pairs(std::span<const Node> nodes, int row, float step);
  static constexpr int node_in_block(int i, int j, int k) { return (k * kSide + j) * kSide + i; }
  int block_number(int x, int y, int z) const {
    return (z * field_.blocks_[1] + y) * field_.blocks_[0] + x;
  }
  std::array<int, 3> block_at(int number) const {
    const int x = number % field_.blocks_[0], rest = number / field_.blocks_[0];
    return {x, rest % field_.blocks_[1], rest / field_.blocks_[1]};
  }
  int coarse_number(int x, int y, int z) const {
    return (z * (field_.blocks_[1] + 1) + y) * (field_.blocks_[0] + 1) + x;
  }
  std::span<Node> fine_nodes(int fine) {
    const auto first = static_cast<std::size_t>(fine % kept_blocks_) * kNodes;
    return std::span(fine_).subspan(first, kNodes);
  }

  DistanceField field_;
  std::optional<TriangleSieve> sieve_;  // none of a core
  std::vector<Node> coarse_, fine_;     // not rounded; fine ones of the last blocks only
  int kept_blocks_ = 0;                 // so many
  std::vector<int> coarse_triangles_;   // the nearest one of each coarse node
  std::vector<int> fine_of_block_;      // -1: none
  std::vector<int> blocks_;             // that have fine nodes, by number
  std::vector<NearestPoint> middles_;   // nearest to the middles of those blocks
  TriangleSieve::List of_block_, of_part_, of_cell_;
  bool one_front_ = true;         // no point was found around which the surface goes in two ways
  int winding_ = 0;               // around points inside; 0: none was asked yet
  std::array<bool, 2> fronts_{};  // whether a front was found inside, outside
};

}  // namespace contactscope

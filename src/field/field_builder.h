#pragma once

#include <atomic>

#include "core/workers.h"
#include "field/distance_field.h"
#include "field/triangle_sieve.h"

namespace contactscope {

class BlockFiller;

/// Fills a DistanceField in the order of the steps of build_distance_field().
///
/// Each thread (Workers) fills a layer of blocks at a time. A block copies nodes from the blocks
/// before it along x, y and z, so a layer begins a row when the layer below has filled it. The
/// field does not depend on the threads: each block gets the same data as with one thread.
class FieldBuilder {
 public:
  /// A closed surface in the frame of the lattice; `watertight`: no hole had to be closed.
  FieldBuilder(std::shared_ptr<const Mesh<double>> surface, bool watertight, const Vec3d& size,
               const FieldSettings& settings);
  FieldBuilder(const Capsule<double>& core, const Vec3d& size, const FieldSettings& settings);

  DistanceField build();

 private:
  friend class BlockFiller;

  static constexpr int kBlock = DistanceField::kBlock;
  static constexpr int kSide = DistanceField::kSide;
  static constexpr int kNodes = DistanceField::kNodes;
  static constexpr int kCells = DistanceField::kCells;
  // Half the diagonal of a cell and of a block, rounded up.
  static constexpr double kHalfCell = 0.8660254037844388;
  static constexpr double kHalfBlock = kBlock * kHalfCell;

  /// Distance and gradient.
  using Node = lanes::Pack<float>;

  /// Sides of the surface on which its fronts were found.
  struct Fronts {
    bool one = true;             // no contradicting winding numbers were found
    int winding = 0;             // around points inside; 0: none known yet
    std::array<bool, 2> seen{};  // whether a front was found inside, outside

    void add_winding(int number);
    void add(const Fronts& other);
  };
  /// Blocks with fine nodes at one z: those of `blocks_` from `first` to before `end`.
  struct Layer {
    int first = 0, end = 0;
    std::atomic<int> filled_rows = 0;  // along x
    Fronts fronts;
    std::vector<std::uint32_t> counts;  // number of triangles of each cell
    std::vector<int> triangles;

    void fill_rows_to(int y);
    void wait_for_row(int y) const;
  };

  /// A block in reach of the band.
  struct NearBlock {
    NearestPoint to_middle;
    std::vector<int> triangles;  // that can be nearest to one of its points; none for a core
  };
  /// Lists of one thread for the survey.
  struct SurveyLists {
    TriangleSieve::List of_group, of_block;
  };

  int thread_count() const;
  void check_bytes(double fine_blocks) const;
  void survey();
  int survey_group(const std::array<int, 3>& group, int seed, SurveyLists& lists);
  std::optional<NearBlock> survey_block(const Vec3d& middle, SurveyLists& lists,
                                        const Vec3d& near) const;
  bool band_reaches(double squared_distance, double half_diagonal) const;
  void sign_coarse();
  void number_blocks();
  void lay_out();
  void make_room();
  void fill_blocks();
  void fill_layer(int z, BlockFiller& filler);
  void gather_triangles();

  /// Distance to the nearest surface point, and the gradient as for a point outside.
  Node unsigned_node(const Vec3d& point, const NearestPoint& nearest) const;
  Node unsigned_node_of_core(const Vec3d& point) const;
  bool is_inside(const Vec3d& point, Fronts& fronts) const;

  /// Writes rounded node pairs of rows of `row` nodes.
  static void write_pairs(std::span<const Node> nodes, int row, float step, NodePair* to);
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
  std::optional<TriangleSieve> sieve_;  // empty for a core
  std::optional<Workers> workers_;
  std::vector<Node> coarse_, fine_;             // not rounded; fine ones of the latest blocks only
  int kept_blocks_ = 0;                         // number of those blocks
  std::vector<int> fine_of_block_;              // -1: none
  std::vector<int> blocks_;                     // numbers of the blocks with fine nodes
  std::vector<std::optional<NearBlock>> near_;  // by block number
  std::vector<Layer> layers_;
  Fronts fronts_;
};

}  // namespace contactscope

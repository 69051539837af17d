#pragma once

#include "draw/scene/scene.h"

/// Trees with few boxes are drawn completely: all nodes and all tested pairs.
namespace contactscope::draw {

inline constexpr std::size_t kFewBoxes = 12;

/// Projects boxes onto a common floor below all of them.
class Floor {
 public:
  explicit Floor(const Scene& scene)
      : up_(scene.header.up == "z" ? 2 : 1),
        right_(up_ == 2 ? 0 : 2),
        ahead_(up_ == 2 ? 1 : 0),
        floor_(scene.frame.broad_phase->cells.front().box.lower[up_]) {
    // One floor for all, so that tiles are drawn in the order in which they overlap.
    for (const trace::Cell& cell : scene.frame.broad_phase->cells)
      floor_ = std::min(floor_, cell.box.lower[up_]);
  }

  int up() const { return up_; }
  int right() const { return right_; }
  int ahead() const { return ahead_; }
  /// The floor's other axis.
  int across(int axis) const { return 3 - up_ - axis; }

  std::vector<Vec3d> tile_of(const trace::Box& box) const {
    std::vector<Vec3d> tile(4, box.lower);
    tile[1][right_] = tile[2][right_] = box.upper[right_];
    tile[2][ahead_] = tile[3][ahead_] = box.upper[ahead_];
    for (Vec3d& corner : tile) corner[up_] = floor_;
    return tile;
  }

 private:
  int up_, right_, ahead_;  // right-handed
  double floor_;
};

struct TestedPair {
  const trace::Bounds *a, *b;
  bool overlaps;
};

/// Pairs that a tree, octree, grid or sweep tested. A trace records only counts by node or cell.
/// The pairs follow from the boxes' nodes, the cells they reach or their spans along an axis. Empty
/// if their number differs from the counts.
std::vector<TestedPair> find_tests(const trace::BroadPhase& phase);

/// Draws nodes as plates on the floor, deeper later, nodes with boxes last; returns that order.
std::vector<trace::Cell> draw_levels(const trace::BroadPhase& phase, const Floor& floor,
                                     Sketch& sketch);
/// `counted`: nodes show their numbers of tests.
void explain_levels(const trace::BroadPhase& phase, bool counted, Sketch& sketch);

/// Links the tested pairs with lines above the boxes.
void link_tested(const Scene& scene, Sketch& sketch);

}  // namespace contactscope::draw

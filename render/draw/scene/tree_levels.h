#pragma once

#include <algorithm>
#include <vector>

#include "draw/scene/scene.h"

/// A tree of few boxes, which is drawn whole: all its nodes, and all pairs that it tested.
namespace contactscope::draw {

inline constexpr std::size_t kFewBoxes = 12;

/// The tile of a box on the floor of all.
class Floor {
 public:
  explicit Floor(const Scene& scene)
      : up_(scene.header.up == "z" ? 2 : 1),
        right_(up_ == 2 ? 0 : 2),
        ahead_(up_ == 2 ? 1 : 0),
        floor_(scene.frame.broad_phase->cells.front().box.lower[up_]) {
    // One floor, so that the order in which tiles are drawn is the one in which they lie.
    for (const trace::Cell& cell : scene.frame.broad_phase->cells)
      floor_ = std::min(floor_, cell.box.lower[up_]);
  }

  int up() const { return up_; }
  int right() const { return right_; }
  int ahead() const { return ahead_; }
  /// The other axis of the floor.
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

/// Two boxes that were tested.
struct TestedPair {
  const trace::Bounds *a, *b;
  bool overlaps;
};

/// The pairs that a tree, an octree, a grid or a sweep tested. A trace counts tests by node or cell and does not
/// name pairs: they follow from the nodes in which boxes hang, the cells that they reach or their spans along an axis, and
/// where these pairs are not as many as the counts say, there are none here.
std::vector<TestedPair> find_tests(const trace::BroadPhase& phase);

/// Nodes as plates on the floor, the deeper ones over those around them and those with boxes over all. Returns them in this order.
std::vector<trace::Cell> draw_levels(const trace::BroadPhase& phase, const Floor& floor,
                                     Sketch& sketch);
/// `counted`: numbers of tests stand in them.
void explain_levels(const trace::BroadPhase& phase, bool counted, Sketch& sketch);

/// Over the boxes: a line between each two that were tested.
void link_tested(const Scene& scene, Sketch& sketch);

}  // namespace contactscope::draw

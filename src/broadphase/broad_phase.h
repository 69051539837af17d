#pragma once

#include <compare>

#include "geometry/shape.h"

namespace contactscope {

/// Two boxes of a broad phase, by their handles; a < b.
struct BoxPair {
  int a = 0;
  int b = 0;
  friend auto operator<=>(const BoxPair&, const BoxPair&) = default;
};

/// Sorts the pairs of one step. Keeps its lists, which are as long as the pairs: allocating them in
/// each step takes longer than sorting.
class PairSorter {
 public:
  /// Sorts pairs of different handles below `handles` ascending, in time linear in both counts if
  /// that is faster than comparing.
  void sort(std::vector<BoxPair>& pairs, int handles);

  std::size_t memory() const;

 private:
  std::vector<int> first_of_a_, first_of_b_;  // index of the first pair of a handle
  std::vector<BoxPair> by_b_;
};

/// Work that a broad phase has done since it was made, independent of the machine.
struct BroadPhaseCounts {
  std::int64_t comparisons = 0;  // of two boxes
  std::int64_t visits = 0;       // of cells, nodes or columns
  std::int64_t swaps = 0;        // of neighbouring endpoints, in sweep and prune
};

/// A part of space or of a tree, and the work of a step there.
struct BroadPhaseCell {
  Aabb<float> box;  // columns have no end along the swept axis
  int depth = 0;    // 0 at the root of a tree, and without levels
  int members = 0;  // boxes in it; 0 for a tree's inner nodes
  int tests = 0;    // of two boxes: one in it, or the node's own
};

/// The lower end of one box and the upper end of another were swapped on an axis.
struct EndSwap {
  int axis = 0;
  float place = 0;  // metres along it, of the end that moved down
  int lower = 0;    // handle of the box with the lower end
  int upper = 0;
  bool meets = false;   // the boxes now overlap along the axis; else they no longer do
  bool counts = false;  // it began or ended a pair
};

/// State of a broad phase's structure in one step, for pictures.
struct BroadPhaseRecord {
  std::vector<BroadPhaseCell> cells;  // those that are not empty
  std::vector<EndSwap> swaps;
  int swept = -1;  // axis along which columns are swept: 0, 1 or 2
  std::vector<int>
      large;  // handles, ascending, of boxes too large for cells; compared with all others
};

/// Finds all pairs of boxes that overlap. Boxes are closed: touching boxes overlap, as in the
/// narrow phase, so that no contact at distance zero is lost between the two. Boxes may be
/// infinite, like that of a plane.
///
/// Boxes are in float, metres. Round double boxes outwards: outward_box().
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;
  BroadPhase& operator=(const BroadPhase&) = delete;
  /// An independent copy with the same boxes.
  virtual std::unique_ptr<BroadPhase> clone() const = 0;

  /// Returns the box's handle, the next number. Throws std::invalid_argument for an empty box or one
  /// with NaN, without changing anything.
  int add(const Aabb<float>& box);
  /// Moves a box any distance. Throws like add().
  void move(int handle, const Aabb<float>& box);

  /// All pairs that overlap now, ascending. The next call overwrites them. `record`: emptied first;
  /// null: not recorded, no cost. Does not change the pairs.
  const std::vector<BoxPair>& pairs(BroadPhaseRecord* record = nullptr);

  const Aabb<float>& box(int handle) const { return boxes_[static_cast<std::size_t>(handle)]; }
  /// Number of boxes, which are never removed.
  int handles() const { return static_cast<int>(boxes_.size()); }
  const BroadPhaseCounts& counts() const { return counts_; }
  /// Bytes in use, including the reserved capacity of its lists.
  std::size_t memory() const;

 protected:
  BroadPhase() = default;
  BroadPhase(const BroadPhase&) = default;

  /// A box was added or moved.
  virtual void added(int /*handle*/) {}
  virtual void moved(int /*handle*/) {}
  /// Reports each overlapping pair once, in any order, by report(). `record`: as in pairs().
  virtual void find_pairs(BroadPhaseRecord* record) = 0;
  virtual std::size_t own_memory() const { return 0; }

  void report(int i, int j) { found_.push_back(i < j ? BoxPair{i, j} : BoxPair{j, i}); }
  void compare(int i, int j) {
    ++counts_.comparisons;
    if (overlaps(box(i), box(j))) report(i, j);
  }

  /// Compares boxes that no structure holds with every other box. Pairs of such boxes are reported
  /// once. `record` lists them.
  void compare_with_all(std::vector<int> large, BroadPhaseRecord* record);

  mutable BroadPhaseCounts counts_;

 private:
  std::vector<Aabb<float>> boxes_;  // by handle
  std::vector<BoxPair> found_;
  PairSorter sorter_;
};

template <class T> std::size_t bytes_of(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

/// Larger boxes, in metres, and infinite ones overflow float in areas and cell indices. Methods
/// that divide space keep them in a list and compare them with every other box.
inline constexpr float kLargestCoordinate = 1e15f;
bool is_bounded(const Aabb<float>& box);

/// Calls visit(node, depth, open) for the nodes of a tree, parents first. open(child) queues a
/// child. `root`: -1 for an empty tree.
template <class Visit> void from_root_down(int root, const Visit& visit) {
  std::vector<std::pair<int, int>> left;  // node, depth
  if (root >= 0) left.emplace_back(root, 0);
  while (!left.empty()) {
    const auto [node, depth] = left.back();
    left.pop_back();
    visit(node, depth, [&left, below = depth + 1](int child) { left.emplace_back(child, below); });
  }
}

/// The smallest float box around a double box.
Aabb<float> outward_box(const Aabb<double>& box);

/// Implements clone() and BroadPhaseInfo::make: `class Tree : public Clonable<Tree>`.
template <class Derived> class Clonable : public BroadPhase {
 public:
  std::unique_ptr<BroadPhase> clone() const override {
    return std::make_unique<Derived>(static_cast<const Derived&>(*this));
  }
};

struct BroadPhaseInfo {
  std::string name;
  std::string summary;  // one line
  std::unique_ptr<BroadPhase> (*make)();
};

/// Table row for a broad phase.
template <class Derived> BroadPhaseInfo info_of(const char* name, const char* summary) {
  return {name, summary, [] { return std::unique_ptr<BroadPhase>(std::make_unique<Derived>()); }};
}

/// All broad phases, in listing order.
const std::vector<BroadPhaseInfo>& broad_phases();

/// A broad phase by name; nullptr if unknown.
std::unique_ptr<BroadPhase> make_broad_phase(std::string_view name);

/// Box of a shape in the world, metres, rounded outwards. Each side is moved out by `margin` and by
/// the possible rounding of the narrow phase in S: if two boxes are separated, the narrow phase
/// finds a distance above both margins. For a mesh it contains the corners of the mesh's box, for a
/// plane everything below it.
template <class S> Aabb<float> world_box(const Shape<S>& shape, const Pose<S>& pose, double margin);

}  // namespace contactscope

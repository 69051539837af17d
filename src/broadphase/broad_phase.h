#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "broadphase/box_pair.h"
#include "geometry/aabb.h"

namespace contactscope {

/// Both ascending.
struct PairChanges {
  std::vector<BoxPair> begun;
  std::vector<BoxPair> ended;
};

/// Work that a broad phase did since it was made: what its time is spent on, whatever the machine.
struct BroadPhaseCounts {
  std::int64_t comparisons = 0;  // of two boxes
  std::int64_t visits = 0;       // of cells, nodes or columns
  std::int64_t swaps = 0;        // of neighbouring endpoints, by sweep and prune
};

/// A part of space or of a tree, and what a step did there.
struct BroadPhaseCell {
  Aabb<float> box;  // of columns without end along the axis that is swept
  int depth = 0;    // 0 at the root of a tree, and where there are no levels
  int members = 0;  // boxes in it; of a tree's node that has others below 0
  int tests = 0;    // of two boxes, of which one is in it, or is that of the node itself
};

/// The lower end of one box and the upper end of another changed places on an axis.
struct EndSwap {
  int axis = 0;
  float place = 0;  // metres along it, of the end that moved down
  int lower = 0;    // handle of the box whose lower end it is
  int upper = 0;
  bool meets = false;   // along the axis the boxes overlap now; else they no longer do
  bool counts = false;  // a pair began, or ended, by it
};

/// What the structure of a broad phase looks like, for somebody who watches a step.
struct BroadPhaseRecord {
  std::vector<BroadPhaseCell> cells;  // those with something in them
  std::vector<EndSwap> swaps;
  int swept = -1;  // the axis along which columns are swept: 0, 1 or 2
  std::vector<int>
      large;  // handles, ascending: compared with all others, as too large for any cell
};

/// Finds which of many boxes overlap. Boxes are closed: those that touch overlap, as in the narrow
/// phase, so that no contact at distance zero is lost between the two. A box may be infinite, as
/// that of a plane is.
///
/// Boxes are in float, metres. Round those of a scene in double outwards: outward_box().
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;
  BroadPhase& operator=(const BroadPhase&) = delete;
  /// Another one with the same boxes, which goes on by itself.
  virtual std::unique_ptr<BroadPhase> clone() const = 0;

  /// Returns the handle of the box: the number of a box that was removed, or the next one.
  /// Throws std::invalid_argument for an empty box or one with NaN; then nothing changes.
  int add(const Aabb<float>& box);
  /// As far as one likes. Throws as add() does.
  void move(int handle, const Aabb<float>& box);
  void remove(int handle);

  /// Every pair that overlaps now, ascending. Another call of this or of changes() overwrites them.
  /// `record`: null when nobody watches, which costs nothing; it changes no pair and is emptied first.
  const std::vector<BoxPair>& pairs(BroadPhaseRecord* record = nullptr);
  /// Which pairs overlap that did not when this was called last, and the reverse. A handle that was
  /// given away again counts as the same box.
  PairChanges changes();
  /// Handles of the boxes that overlap `box`, ascending.
  std::vector<int> query(const Aabb<float>& box) const;

  bool has(int handle) const;
  const Aabb<float>& box(int handle) const { return boxes_[static_cast<std::size_t>(handle)]; }
  /// One past the largest handle there ever was.
  int handles() const { return static_cast<int>(boxes_.size()); }
  const BroadPhaseCounts& counts() const { return counts_; }
  /// Bytes that it holds, with room that its lists keep for more.
  std::size_t memory() const;

 protected:
  BroadPhase() = default;
  BroadPhase(const BroadPhase&) = default;

  /// A box came, has another place than `from`, or is about to go.
  virtual void added(int /*handle*/) {}
  virtual void moved(int /*handle*/, const Aabb<float>& /*from*/) {}
  virtual void removing(int /*handle*/) {}
  /// Appends every overlapping pair once, in any order, by report().
  /// `record`: as of pairs().
  virtual void find_pairs(BroadPhaseRecord* record) = 0;
  /// Appends to `found` every box that overlaps, once, in any order. Where there is no structure for
  /// it: looks at all of them.
  virtual void find(const Aabb<float>& box, std::vector<int>& found) const;
  virtual std::size_t own_memory() const { return 0; }

  void report(int i, int j) { found_.push_back(i < j ? BoxPair{i, j} : BoxPair{j, i}); }
  /// Reports i and j if their boxes overlap.
  void compare(int i, int j) {
    ++counts_.comparisons;
    if (overlaps(box(i), box(j))) report(i, j);
  }

  /// Compares boxes that no structure holds with every other box; of two such the first one reports.
  /// They are told in `record`.
  void compare_with_all(std::vector<int> large, BroadPhaseRecord* record);

  mutable BroadPhaseCounts counts_;

 private:
  std::vector<Aabb<float>> boxes_;  // by handle; empty where there is none
  std::vector<int> free_;
  std::vector<BoxPair> found_;
  std::vector<BoxPair> last_;  // of changes()
  PairSorter sorter_;
};

template <class T>
std::size_t bytes_of(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

/// Boxes beyond this, in metres, and infinite ones have areas and cells that float cannot count.
/// Whatever divides space keeps them in a list and compares them with every other box.
inline constexpr float kLargestCoordinate = 1e15f;
bool is_bounded(const Aabb<float>& box);

/// Calls tell(node, depth, open) for the nodes of a tree, a parent before its children: open(child)
/// puts off each child that is to be told. `root`: -1 of a tree without nodes.
template <class Tell>
void from_root_down(int root, const Tell& tell) {
  std::vector<std::pair<int, int>> left;  // node, depth
  if (root >= 0) left.emplace_back(root, 0);
  while (!left.empty()) {
    const auto [node, depth] = left.back();
    left.pop_back();
    tell(node, depth, [&left, below = depth + 1](int child) { left.emplace_back(child, below); });
  }
}

/// The smallest box in float around one in double.
Aabb<float> outward_box(const Aabb<double>& box);

/// What clone() and BroadPhaseInfo::make are made of: `class Tree : public Clonable<Tree>`.
template <class Derived>
class Clonable : public BroadPhase {
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

/// A row of the table for one of them.
template <class Derived>
BroadPhaseInfo info_of(const char* name, const char* summary) {
  return {name, summary, [] { return std::unique_ptr<BroadPhase>(std::make_unique<Derived>()); }};
}

/// Every broad phase, in the order in which to list them.
const std::vector<BroadPhaseInfo>& broad_phases();

/// A broad phase by name; nullptr when there is none such.
std::unique_ptr<BroadPhase> make_broad_phase(std::string_view name);

}  // namespace contactscope

#include "broadphase/broad_phase.h"

namespace contactscope {
namespace {

/// Margin of a leaf on each side, relative to its box's largest side. Smaller moves need no update.
constexpr float kMargin = 0.1f;

/// A dynamic tree of boxes. A leaf is inserted where the areas of the boxes above it grow least.
/// Rotations on the path back to the root keep the tree balanced. Infinite boxes are compared with
/// all.
/// Source: Catto 2019, "Dynamic Bounding Volume Hierarchies"; Adelson-Velsky and Landis 1962.
class Tree : public Clonable<Tree> {
  struct Node {
    Aabb<float> box;
    int parent = -1;
    int children[2] = {-1, -1};
    int height = 0;
    int handle = -1;  // of a leaf

    bool is_leaf() const { return children[0] < 0; }
  };

  void added(int handle) override {
    leaves_.resize(static_cast<std::size_t>(handles()), -1);
    if (is_bounded(box(handle))) {
      insert(handle);
    } else {
      endless_.push_back(handle);
    }
  }

  void moved(int handle) override {
    const int leaf = at(leaves_, handle);
    // Leaves that have become far too wide are also inserted again.
    if (leaf >= 0 && is_bounded(box(handle)) && at(nodes_, leaf).box.contains(box(handle)) &&
        widened(widened(box(handle))).contains(at(nodes_, leaf).box)) {
      return;
    }
    take_out(handle);
    added(handle);
  }

  void take_out(int handle) {
    const int leaf = std::exchange(at(leaves_, handle), -1);
    if (leaf < 0) {
      std::erase(endless_, handle);
      return;
    }
    const int parent = at(nodes_, leaf).parent;
    free_.push_back(leaf);
    if (parent < 0) {
      root_ = -1;
      return;
    }
    const int sibling = child_of(parent, at(nodes_, parent).children[0] == leaf ? 1 : 0);
    replace(parent, sibling);
    free_.push_back(parent);
    refit_above(at(nodes_, sibling).parent);
  }

  static Aabb<float> widened(const Aabb<float>& box) {
    const Vec3<float> by = Vec3<float>::Constant(kMargin * box.extent().maxCoeff());
    return {box.lower - by, box.upper + by};
  }

  int new_node() {
    if (free_.empty()) {
      nodes_.emplace_back();
      return count_of(nodes_) - 1;
    }
    const int node = free_.back();
    free_.pop_back();
    at(nodes_, node) = {};
    return node;
  }

  int child_of(int node, int side) const { return at(nodes_, node).children[side]; }

  /// Puts `by` in the place of `node`.
  void replace(int node, int by) {
    const int parent = at(nodes_, node).parent;
    at(nodes_, by).parent = parent;
    if (parent < 0) {
      root_ = by;
    } else {
      at(nodes_, parent).children[child_of(parent, 0) == node ? 0 : 1] = by;
    }
  }

  void hang(int node, int side, int child) {
    at(nodes_, node).children[side] = child;
    at(nodes_, child).parent = node;
  }

  void insert(int handle) {
    const int leaf = new_node();
    at(nodes_, leaf).handle = handle;
    at(nodes_, leaf).box = widened(box(handle));
    at(leaves_, handle) = leaf;
    if (root_ < 0) {
      root_ = leaf;
      return;
    }
    const int sibling = best_sibling(at(nodes_, leaf).box);
    const int above = new_node();
    replace(sibling, above);
    hang(above, 0, sibling);
    hang(above, 1, leaf);
    refit_above(above);
  }

  /// Descends to the node of least cost: this one, or one below a child, whose boxes then grow.
  int best_sibling(const Aabb<float>& box) const {
    const auto grown_area = [&](int node) {
      return surface_area(merged(at(nodes_, node).box, box));
    };
    int node = root_;
    while (!at(nodes_, node).is_leaf()) {
      ++counts_.visits;
      const float grown = grown_area(node);
      // Cost of growing this node, included in all choices below it.
      const float inherited = grown - surface_area(at(nodes_, node).box);
      const auto cost_below = [&](int child) {
        const float area = grown_area(child);
        return inherited +
               (at(nodes_, child).is_leaf() ? area : area - surface_area(at(nodes_, child).box));
      };
      const float left = cost_below(child_of(node, 0)), right = cost_below(child_of(node, 1));
      if (grown < std::min(left, right)) break;
      node = child_of(node, left <= right ? 0 : 1);
    }
    return node;
  }

  void refit_above(int node) {
    while (node >= 0) {
      node = balanced(node);
      fit(node);
      node = at(nodes_, node).parent;
    }
  }

  void fit(int node) {
    const Node &left = at(nodes_, child_of(node, 0)), &right = at(nodes_, child_of(node, 1));
    at(nodes_, node).box = merged(left.box, right.box);
    at(nodes_, node).height = 1 + std::max(left.height, right.height);
  }

  /// Lifts the higher child by a rotation if the heights differ by two. Returns the upper node.
  ///
  ///        node                 high
  ///       /    |               /    |
  ///     low    high   ->    node    x      x: the higher child of `high`
  ///           /    |       /    |
  ///          x      y    low     y
  int balanced(int node) {
    if (at(nodes_, node).is_leaf()) return node;
    const int heights[2] = {at(nodes_, child_of(node, 0)).height,
                            at(nodes_, child_of(node, 1)).height};
    if (std::abs(heights[0] - heights[1]) < 2) return node;
    const int high_side = heights[1] > heights[0] ? 1 : 0;
    const int high = child_of(node, high_side);
    const int x_side =
        at(nodes_, child_of(high, 0)).height > at(nodes_, child_of(high, 1)).height ? 0 : 1;
    const int y = child_of(high, 1 - x_side);
    replace(node, high);
    hang(node, high_side, y);
    hang(high, 1 - x_side, node);
    fit(node);
    return high;
  }

  void find_pairs(BroadPhaseRecord* record) override {
    std::vector<int> tests(record != nullptr ? nodes_.size() : 0);  // of each node's box
    compare_with_all(endless_, record);
    if (root_ < 0) return;
    // Two nodes: compare the leaves of both. The same node twice: compare its own leaves.
    open_.assign(1, {root_, root_});
    while (!open_.empty()) {
      const auto [a, b] = open_.back();
      open_.pop_back();
      ++counts_.visits;
      const Node &first = at(nodes_, a), &second = at(nodes_, b);
      if (a == b) {
        if (first.is_leaf()) continue;
        const auto [left, right] = first.children;
        open_.insert(open_.end(), {{left, left}, {right, right}, {left, right}});
        continue;
      }
      if (record != nullptr) {
        ++at(tests, a);
        ++at(tests, b);
      }
      if (!overlaps(first.box, second.box)) {
        continue;
      } else if (first.is_leaf() && second.is_leaf()) {
        compare(first.handle, second.handle);
      } else if (second.is_leaf() || (!first.is_leaf() && first.height >= second.height)) {
        for (const int child : first.children) open_.emplace_back(child, b);
      } else {
        for (const int child : second.children) open_.emplace_back(a, child);
      }
    }
    if (record != nullptr) report(tests, *record);
  }

  void report(const std::vector<int>& tests, BroadPhaseRecord& record) const {
    from_root_down(root_, [&](int index, int depth, const auto& open) {
      const Node& node = at(nodes_, index);
      record.cells.push_back({node.box, depth, node.is_leaf() ? 1 : 0, at(tests, index)});
      if (node.is_leaf()) return;
      for (const int child : node.children) open(child);
    });
  }

  std::size_t own_memory() const override {
    return bytes_of(nodes_) + bytes_of(leaves_) + bytes_of(free_) + bytes_of(endless_) +
           bytes_of(open_);
  }

  std::vector<Node> nodes_;
  int root_ = -1;
  std::vector<int> leaves_;  // node of each handle; -1 for infinite boxes
  std::vector<int> free_;    // unused nodes
  std::vector<int> endless_;
  std::vector<std::pair<int, int>> open_;  // pairs of nodes that a search has yet to visit
};

}  // namespace

BroadPhaseInfo tree_broad_phase() {
  return info_of<Tree>("tree", "a dynamic tree of boxes, balanced: for anything");
}

}  // namespace contactscope

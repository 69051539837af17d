#include "broadphase/broad_phase.h"

namespace contactscope {
namespace {

constexpr int kDeepestLevel = 24;  // halvings of the root; boxes of a ten-millionth share a node

/// A loose octree: each box is in the node of its size that contains its centre, and a node extends
/// to the boxes below it, by at most half of its side. A box is in one node, found without visiting
/// others. Suits varying density. The root doubles until it contains every centre and is as large as
/// the largest box. Infinite boxes are compared with all.
/// Source: Ulrich 2000, "Loose Octrees", Game Programming Gems 1.
class Octree : public Clonable<Octree> {
  struct Node {
    int parent = -1;
    std::array<int, 8> children = {-1, -1, -1, -1, -1, -1, -1, -1};
    int below = 0;          // boxes in it and below it
    Aabb<float> reach;      // around those boxes, and perhaps some that have left
    std::vector<int> here;  // handles
  };
  /// Region of a node's centres: metres, half of its side.
  struct Cube {
    Vec3<float> center = Vec3<float>::Zero();
    float half = 0;

    int octant(const Vec3<float>& point) const {
      return (point.x() >= center.x()) + 2 * (point.y() >= center.y()) +
             4 * (point.z() >= center.z());
    }
    Cube child(int octant) const {
      const float q = 0.5f * half;
      return {center + Vec3<float>(octant & 1 ? q : -q, octant & 2 ? q : -q, octant & 4 ? q : -q),
              q};
    }
    bool holds(const Vec3<float>& point) const {
      return (point - center).cwiseAbs().maxCoeff() <= half;
    }
  };

  void added(int handle) override {
    homes_.resize(static_cast<std::size_t>(handles()), -1);
    const Aabb<float>& added = box(handle);
    if (!is_bounded(added)) {
      endless_.push_back(handle);
      at(homes_, handle) = -1;
      return;
    }
    const Vec3<float> center = added.center();
    const float half = 0.5f * added.extent().maxCoeff();
    if (root_ < 0) {
      root_ = new_node(-1);
      cube_ = {center, std::max(half, 1e-30f)};
    }
    while (!cube_.holds(center) || cube_.half < half) grow(center);

    int node = root_;
    Cube cube = cube_;
    for (int depth = 0; depth < kDeepestLevel && 0.5f * cube.half >= half; ++depth) {
      count_in(node, handle);
      const int octant = cube.octant(center);
      cube = cube.child(octant);
      if (at(at(nodes_, node).children, octant) < 0) {
        const int child = new_node(node);
        at(at(nodes_, node).children, octant) = child;
      }
      node = at(at(nodes_, node).children, octant);
    }
    count_in(node, handle);
    at(nodes_, node).here.push_back(handle);
    at(homes_, handle) = node;
  }

  void moved(int handle) override {
    int node = at(homes_, handle);
    std::vector<int>& list = node < 0 ? endless_ : at(nodes_, node).here;
    *std::ranges::find(list, handle) = list.back();
    list.pop_back();
    for (; node >= 0; node = at(nodes_, node).parent) {
      if (--at(nodes_, node).below == 0) at(nodes_, node).reach = {};
    }
    added(handle);
  }

  void find_pairs(BroadPhaseRecord* record) override {
    std::vector<int> tests(record != nullptr ? nodes_.size() : 0);  // of each node's boxes
    compare_with_all(endless_, record);
    for (int i = 0; i < handles(); ++i) {
      if (at(homes_, i) < 0) continue;
      visit(box(i), [&](int j) {
        if (j <= i) return;
        compare(i, j);
        if (record != nullptr) ++at(tests, at(homes_, j));
      });
    }
    if (record != nullptr) report(tests, *record);
  }

  void report(const std::vector<int>& tests, BroadPhaseRecord& record) const {
    from_root_down(root_, [&](int index, int depth, const auto& open) {
      const Node& node = at(nodes_, index);
      record.cells.push_back({node.reach, depth, count_of(node.here), at(tests, index)});
      for (const int child : node.children)
        if (child >= 0 && at(nodes_, child).below > 0) open(child);
    });
  }

  /// Calls test(handle) for all boxes in nodes that reach into a box.
  template <class Test> void visit(const Aabb<float>& box, Test&& test) {
    open_.clear();
    if (root_ >= 0) open_.push_back(root_);
    while (!open_.empty()) {
      const Node& node = at(nodes_, open_.back());
      open_.pop_back();
      ++counts_.visits;
      if (!overlaps(node.reach, box)) continue;
      for (const int handle : node.here) test(handle);
      for (const int child : node.children)
        if (child >= 0 && at(nodes_, child).below > 0) open_.push_back(child);
    }
  }

  int new_node(int parent) {
    nodes_.emplace_back().parent = parent;
    return count_of(nodes_) - 1;
  }

  void count_in(int node, int handle) {
    ++at(nodes_, node).below;
    at(nodes_, node).reach.include(box(handle));
  }

  /// Doubles the root towards a point: the old root becomes a child of a new one if it has boxes.
  void grow(const Vec3<float>& towards) {
    Cube larger = {cube_.center, 2 * cube_.half};
    for (int i = 0; i < 3; ++i)
      larger.center[i] += towards[i] >= cube_.center[i] ? cube_.half : -cube_.half;
    if (at(nodes_, root_).below > 0) {
      const int above = new_node(-1);
      at(nodes_, above).below = at(nodes_, root_).below;
      at(nodes_, above).reach = at(nodes_, root_).reach;
      at(at(nodes_, above).children, larger.octant(cube_.center)) = root_;
      at(nodes_, root_).parent = above;
      root_ = above;
    }
    cube_ = larger;
  }

  std::size_t own_memory() const override {
    std::size_t bytes = bytes_of(nodes_) + bytes_of(homes_) + bytes_of(endless_) + bytes_of(open_);
    for (const Node& node : nodes_) bytes += bytes_of(node.here);
    return bytes;
  }

  std::vector<Node> nodes_;
  int root_ = -1;
  Cube cube_;               // of the root
  std::vector<int> homes_;  // node of each handle; -1 for infinite boxes
  std::vector<int> endless_;
  std::vector<int> open_;  // nodes that a search has yet to visit
};

}  // namespace

BroadPhaseInfo octree_broad_phase() {
  return info_of<Octree>("octree",
                         "a loose octree, a box in the node of its size: for varying density");
}

}  // namespace contactscope

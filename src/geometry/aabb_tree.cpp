#include "geometry/aabb_tree.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

#include "trace/pair.h"

namespace contactscope {
namespace {

// Wald 2007 finds 16 bins as good as a full sweep within a few per cent.
constexpr int kBins = 16;
// Below, splitting no longer pays by the estimate itself; above, one leaf could hold everything.
constexpr int kMaxLeaf = 4;
// A binned split may cut off a single triangle each time. From this depth on halves are cut, and an
// int counts no more triangles than the rest of the levels holds.
constexpr int kMaxSahDepth = kMaxAabbTreeDepth - 32;

using Box = Aabb<double>;

struct Split {
  int axis = -1;
  int bin = 0;                                            // the first one that goes right
  double cost = std::numeric_limits<double>::infinity();  // expected tests of boxes
};

struct Bin {
  Box box;
  int count = 0;
};

/// Binned build with the surface area heuristic after Wald 2007, section 3: the cost of a cut is
/// the number of triangles on each side, weighted by how likely a query that reached the node
/// reaches that side, for which the surface area of its box stands. Deviations: bins along all
/// three axes, not only the longest (a better tree for three times the work); and the tree is laid
/// out depth first. Steps:
///   1. the box of all triangles, and the box of their centres;
///   2. sort centres into bins along each axis, and sweep the cuts between bins from both sides;
///   3. a leaf, if testing all its triangles costs less than the best cut;
///   4. without a cut (all centres equal), or too deep: half of the triangles by centre along the
///      longest axis, ties by index, so that copies of one triangle make a balanced tree;
///   5. the same for the left side, then for the right one.
class Builder {
 public:
  explicit Builder(std::span<const Box> boxes)
      : boxes_(boxes), centers_(mapped(boxes, &Box::center)) {
    tree_.triangles.resize(boxes.size());
    std::iota(tree_.triangles.begin(), tree_.triangles.end(), 0);
  }

  AabbTree<double> run() {
    tree_.nodes.reserve(boxes_.size());
    if (!boxes_.empty()) build(tree_.triangles, 1);
    tree_.boxes = mapped(tree_.triangles, [&](int triangle) { return at(boxes_, triangle); });
    return std::move(tree_);
  }

 private:
  // `triangles` are a part of the tree's. Recursive, and never deeper than kMaxAabbTreeDepth.
  void build(std::span<int> triangles, int depth) {
    assert(depth <= kMaxAabbTreeDepth);
    Box bounds, centers;
    for (const int triangle : triangles) {
      bounds.include(at(boxes_, triangle));
      centers.include(at(centers_, triangle));
    }
    const std::size_t node = tree_.nodes.size();
    const auto first = static_cast<int>(triangles.data() - tree_.triangles.data());
    tree_.nodes.push_back({bounds, first, 0});

    Split split;
    if (depth < kMaxSahDepth) split = best_split(triangles, bounds, centers);
    const int count = count_of(triangles);
    if (count == 1 || (count <= kMaxLeaf && !(split.cost < count))) {
      tree_.nodes[node].count = count;
      std::ranges::sort(triangles);
      return;
    }
    const std::size_t left = split.axis >= 0 ? partition(triangles, split, centers)
                                             : partition_halves(triangles, centers);
    build(triangles.first(left), depth + 1);
    build(triangles.subspan(left), depth + 1);
    tree_.nodes[node].next = static_cast<int>(tree_.nodes.size());
  }

  static int bin_of(double center, double lower, double extent) {
    return std::min(static_cast<int>((center - lower) / extent * kBins), kBins - 1);
  }

  Split best_split(std::span<const int> triangles, const Box& bounds, const Box& centers) const {
    Split best;
    const Vec3d extent = centers.extent();
    for (int axis = 0; axis < 3; ++axis) {
      if (!(extent[axis] > 0)) continue;
      std::array<Bin, kBins> bins;
      for (const int triangle : triangles) {
        const double center = at(centers_, triangle)[axis];
        Bin& bin = at(bins, bin_of(center, centers.lower[axis], extent[axis]));
        bin.box.include(at(boxes_, triangle));
        ++bin.count;
      }
      sweep(bins, axis, surface_area(bounds), best);
    }
    return best;
  }

  /// Tries every cut between two bins that leaves triangles on both sides.
  static void sweep(const std::array<Bin, kBins>& bins, int axis, double area, Split& best) {
    std::array<double, kBins> right_cost{};  // of this bin and all above
    Bin right;
    for (std::size_t i = kBins - 1; i > 0; --i) {
      right.box.include(bins[i].box);
      right.count += bins[i].count;
      right_cost[i] = right.count > 0 ? surface_area(right.box) / area * right.count : 0;
    }
    Bin left;
    const int all = right.count + bins[0].count;
    for (std::size_t i = 1; i < kBins; ++i) {
      left.box.include(bins[i - 1].box);
      left.count += bins[i - 1].count;
      if (left.count == 0 || left.count == all) continue;
      // Two boxes of nodes are tested first; boxes of triangles cost as much each.
      const double cost = 2 + surface_area(left.box) / area * left.count + right_cost[i];
      if (cost < best.cost) best = {axis, static_cast<int>(i), cost};
    }
  }

  /// Both put the triangles of the left side first, and say how many those are.
  std::size_t partition(std::span<int> triangles, const Split& split, const Box& centers) const {
    const double lower = centers.lower[split.axis];
    const double extent = centers.upper[split.axis] - lower;
    const auto right = std::partition(triangles.begin(), triangles.end(), [&](int triangle) {
      return bin_of(at(centers_, triangle)[split.axis], lower, extent) < split.bin;
    });
    return static_cast<std::size_t>(right - triangles.begin());
  }
  std::size_t partition_halves(std::span<int> triangles, const Box& centers) const {
    int axis = 0;
    centers.extent().maxCoeff(&axis);
    const std::size_t half = triangles.size() / 2;
    const auto middle = triangles.begin() + static_cast<std::ptrdiff_t>(half);
    std::ranges::nth_element(triangles, middle, {}, [&](int triangle) {
      return std::pair(at(centers_, triangle)[axis], triangle);
    });
    return half;
  }

  std::span<const Box> boxes_;
  std::vector<Vec3d> centers_;
  AabbTree<double> tree_;
};

template <class S>
trace::Box traced(const Aabb<S>& box) {
  return {box.lower.template cast<double>(), box.upper.template cast<double>()};
}

}  // namespace

template <class S>
trace::Tree AabbTree<S>::recorded_query(const Aabb<S>& box) const {
  trace::Tree record;
  record.box = traced(box);
  std::vector<int> ends;  // of the subtrees that node i is in
  for (int i = 0; i < count_of(nodes);) {
    while (!ends.empty() && ends.back() <= i) ends.pop_back();
    const Node& node = at(nodes, i);
    const bool hit = overlaps(node.box, box);
    record.visits.push_back({traced(node.box), count_of(ends), node.leaf(), hit});
    if (hit && node.leaf()) {
      any_of_leaf(node, box, [&](int triangle) {
        record.candidates.push_back(triangle);
        return false;
      });
    }
    if (!node.leaf()) ends.push_back(node.next);
    i = hit || node.leaf() ? i + 1 : node.next;
  }
  return record;
}

template <class S>
void AabbTree<S>::refit(std::span<const Vec3<S>> vertices,
                        std::span<const std::array<int, 3>> corners) {
  assert(corners.size() == triangles.size());
  boxes = mapped(triangles, [&](int triangle) { return box_of(vertices, at(corners, triangle)); });
  // Backwards: whatever is below a node stands behind it.
  for (std::size_t i = nodes.size(); i-- > 0;) {
    Node& node = nodes[i];
    node.box = {};
    if (node.leaf()) {
      for (int k = node.next; k < node.next + node.count; ++k) node.box.include(at(boxes, k));
    } else {
      node.box.include(nodes[i + 1].box);
      node.box.include(at(nodes, right_of(static_cast<int>(i))).box);
    }
  }
}

AabbTree<double> build_aabb_tree(std::span<const Aabb<double>> boxes) {
  return Builder(boxes).run();
}

template <class T>
AabbTree<T> aabb_tree_cast(const AabbTree<double>& tree) {
  const auto cast = [](const AabbTree<double>::Node& node) -> typename AabbTree<T>::Node {
    return {node.box.cast<T>(), node.next, node.count};
  };
  return {mapped(tree.nodes, cast), tree.triangles, cast_each<Aabb<T>>(tree.boxes)};
}

template struct AabbTree<float>;
template struct AabbTree<double>;
template AabbTree<float> aabb_tree_cast(const AabbTree<double>&);
template AabbTree<double> aabb_tree_cast(const AabbTree<double>&);

}  // namespace contactscope

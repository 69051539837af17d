#include "geometry/aabb_tree.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>
#include <numeric>

#include "core/pack.h"
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

/// A box in registers of two doubles: lower x, y, z and then upper x, y, z with their signs turned,
/// so that to grow is three minima.
struct PackedBox {
  using Pack = lanes::Pack<double>;
  std::array<Pack, 3> numbers;

  PackedBox() = default;  // not set
  explicit PackedBox(const Box& box)
      : numbers{Pack{box.lower.x(), box.lower.y()}, Pack{box.lower.z(), -box.upper.x()},
                Pack{-box.upper.y(), -box.upper.z()}} {}

  /// Of equal numbers the one that was there stays, as with Aabb::include: 0 and -0 are equal.
  void include(const PackedBox& other) {
    for (std::size_t k = 0; k < 3; ++k) numbers[k] = lanes::smaller(other.numbers[k], numbers[k]);
  }
  Box box() const {
    return {{numbers[0][0], numbers[0][1], numbers[1][0]},
            {-numbers[1][1], -numbers[2][0], -numbers[2][1]}};
  }
};

/// Triangles by where their centre lies along one axis.
struct Bins {
  std::array<PackedBox, kBins> boxes;
  std::array<int, kBins> counts{};
  std::uint32_t used = 0;  // bit i: bin i has a triangle

  Bins() { boxes.fill(PackedBox(Box{})); }
  void add(int bin, const PackedBox& box) {
    at(boxes, bin).include(box);
    ++at(counts, bin);
    used |= 1u << bin;
  }
};

/// A triangle while the tree is built. Kept together and moved with its place in the tree, so that
/// each level reads memory forwards.
struct Item {
  PackedBox box;
  Vec3d center;
  int triangle;
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
  explicit Builder(std::span<const Box> boxes) : boxes_(boxes) {
    items_.reserve(boxes.size());
    for (const Box& box : boxes) items_.push_back({PackedBox(box), box.center(), count_of(items_)});
  }

  AabbTree<double> run() {
    tree_.nodes.reserve(boxes_.size());
    if (!boxes_.empty()) build(items_, 1);
    tree_.triangles = mapped(items_, &Item::triangle);
    tree_.boxes = mapped(tree_.triangles, [&](int triangle) { return at(boxes_, triangle); });
    return std::move(tree_);
  }

 private:
  // `items` are a part of all. Recursive, and never deeper than kMaxAabbTreeDepth.
  void build(std::span<Item> items, int depth) {
    assert(depth <= kMaxAabbTreeDepth);
    PackedBox packed(Box{});
    Box centers;
    for (const Item& item : items) {
      packed.include(item.box);
      centers.include(item.center);
    }
    const Box bounds = packed.box();
    const std::size_t node = tree_.nodes.size();
    const auto first = static_cast<int>(items.data() - items_.data());
    tree_.nodes.push_back({bounds, first, 0});

    Split split;
    if (depth < kMaxSahDepth) split = best_split(items, bounds, centers);
    const int count = count_of(items);
    if (count == 1 || (count <= kMaxLeaf && !(split.cost < count))) {
      tree_.nodes[node].count = count;
      std::ranges::sort(items, {}, &Item::triangle);
      return;
    }
    const std::size_t left =
        split.axis >= 0 ? partition(items, split, centers) : partition_halves(items, centers);
    build(items.first(left), depth + 1);
    build(items.subspan(left), depth + 1);
    tree_.nodes[node].next = static_cast<int>(tree_.nodes.size());
  }

  static int bin_of(double center, double lower, double extent) {
    return std::min(static_cast<int>((center - lower) / extent * kBins), kBins - 1);
  }

  static Split best_split(std::span<const Item> items, const Box& bounds, const Box& centers) {
    Split best;
    const Vec3d extent = centers.extent();
    const double area = surface_area(bounds);
    for (int axis = 0; axis < 3; ++axis) {
      if (!(extent[axis] > 0)) continue;
      Bins bins;
      for (const Item& item : items)
        bins.add(bin_of(item.center[axis], centers.lower[axis], extent[axis]), item.box);
      sweep(bins, axis, area, best);
    }
    return best;
  }

  /// Tries every cut between two bins that leaves triangles on both sides. Of cuts with only empty
  /// bins between them, which are the same cut, the first one is taken.
  static void sweep(const Bins& bins, int axis, double area, Split& best) {
    std::array<double, kBins> right_cost;  // of this bin and all above; set where a triangle is
    std::array<int, kBins> used{};         // ascending
    int used_count = 0, all = 0;
    for (std::uint32_t rest = bins.used; rest != 0; rest &= rest - 1)
      at(used, used_count++) = std::countr_zero(rest);
    PackedBox right = at(bins.boxes, at(used, used_count - 1));
    for (int k = used_count - 1; k > 0; --k) {
      right.include(at(bins.boxes, at(used, k)));
      all += at(bins.counts, at(used, k));
      at(right_cost, k) = surface_area(right.box()) / area * all;
    }
    PackedBox left = at(bins.boxes, at(used, 0));
    int left_count = 0;
    for (int k = 1; k < used_count; ++k) {
      left.include(at(bins.boxes, at(used, k - 1)));
      left_count += at(bins.counts, at(used, k - 1));
      // Two boxes of nodes are tested first; boxes of triangles cost as much each.
      const double cost = 2 + surface_area(left.box()) / area * left_count + at(right_cost, k);
      if (cost < best.cost) best = {axis, at(used, k - 1) + 1, cost};
    }
  }

  /// Both put the triangles of the left side first, and say how many those are.
  static std::size_t partition(std::span<Item> items, const Split& split, const Box& centers) {
    const double lower = centers.lower[split.axis];
    const double extent = centers.upper[split.axis] - lower;
    const auto right = std::partition(items.begin(), items.end(), [&](const Item& item) {
      return bin_of(item.center[split.axis], lower, extent) < split.bin;
    });
    return static_cast<std::size_t>(right - items.begin());
  }
  static std::size_t partition_halves(std::span<Item> items, const Box& centers) {
    int axis = 0;
    centers.extent().maxCoeff(&axis);
    const std::size_t half = items.size() / 2;
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(half);
    std::ranges::nth_element(items, middle, {}, [&](const Item& item) {
      return std::pair(item.center[axis], item.triangle);
    });
    return half;
  }

  std::span<const Box> boxes_;
  std::vector<Item> items_;  // in tree order in the end
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

template <class S>
double AabbTree<S>::expected_cost() const {
  double weighted = 0;
  for (const Node& node : nodes) {
    const int boxes_tested = node.leaf() ? node.count : 2;
    weighted += boxes_tested * surface_area(node.box.template cast<double>());
  }
  const double all = surface_area(bounds().template cast<double>());
  // Of triangles on one line: every query meets every box.
  return all > 0 ? weighted / all : static_cast<double>(nodes.size() + triangles.size());
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

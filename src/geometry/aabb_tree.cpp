#include "geometry/aabb_tree.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

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
  explicit Builder(std::span<const Box> boxes) : boxes_(boxes) {
    centers_.reserve(boxes.size());
    for (const Box& box : boxes) centers_.push_back(box.center());
    tree_.triangles.resize(boxes.size());
    std::iota(tree_.triangles.begin(), tree_.triangles.end(), 0);
  }

  AabbTree<double> run() {
    const int count = static_cast<int>(boxes_.size());
    tree_.nodes.reserve(boxes_.size());
    if (count > 0) build(0, count, 1);
    tree_.boxes.reserve(boxes_.size());
    for (const int triangle : tree_.triangles) tree_.boxes.push_back(box(triangle));
    return std::move(tree_);
  }

 private:
  const Box& box(int triangle) const { return boxes_[static_cast<std::size_t>(triangle)]; }
  const Vec3d& center(int triangle) const { return centers_[static_cast<std::size_t>(triangle)]; }
  std::span<int> range(int begin, int end) {
    return std::span(tree_.triangles)
        .subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
  }

  // Recursive, and never deeper than kMaxAabbTreeDepth.
  void build(int begin, int end, int depth) {
    assert(depth <= kMaxAabbTreeDepth);
    Box bounds;
    Box centers;
    for (const int triangle : range(begin, end)) {
      bounds.include(box(triangle));
      centers.include(center(triangle));
    }
    const std::size_t node = tree_.nodes.size();
    tree_.nodes.push_back({bounds, begin, 0});

    Split split;
    if (depth < kMaxSahDepth) split = best_split(range(begin, end), bounds, centers);
    const int count = end - begin;
    if (count == 1 || (count <= kMaxLeaf && !(split.cost < count))) {
      tree_.nodes[node].count = count;
      const std::span<int> triangles = range(begin, end);
      std::sort(triangles.begin(), triangles.end());
      return;
    }
    const int middle = split.axis >= 0 ? partition(begin, end, split, centers)
                                       : partition_halves(begin, end, centers);
    build(begin, middle, depth + 1);
    build(middle, end, depth + 1);
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
        const int at = bin_of(center(triangle)[axis], centers.lower[axis], extent[axis]);
        Bin& bin = bins[static_cast<std::size_t>(at)];
        bin.box.include(box(triangle));
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

  int partition(int begin, int end, const Split& split, const Box& centers) {
    const double lower = centers.lower[split.axis];
    const double extent = centers.upper[split.axis] - lower;
    const std::span<int> triangles = range(begin, end);
    const auto middle = std::partition(triangles.begin(), triangles.end(), [&](int triangle) {
      return bin_of(center(triangle)[split.axis], lower, extent) < split.bin;
    });
    return begin + static_cast<int>(middle - triangles.begin());
  }

  int partition_halves(int begin, int end, const Box& centers) {
    int axis = 0;
    centers.extent().maxCoeff(&axis);
    const std::span<int> triangles = range(begin, end);
    const int half = (end - begin) / 2;
    std::nth_element(triangles.begin(), triangles.begin() + half, triangles.end(),
                     [&](int one, int other) {
                       const double a = center(one)[axis];
                       const double b = center(other)[axis];
                       return a < b || (a == b && one < other);
                     });
    return begin + half;
  }

  std::span<const Box> boxes_;
  std::vector<Vec3d> centers_;
  AabbTree<double> tree_;
};

/// Calls visit(i, depth) for each node before those below it; visit says whether to go on there.
/// The root has depth 0.
template <class S, class Visit>
void walk(const AabbTree<S>& tree, const Visit& visit) {
  const int node_count = static_cast<int>(tree.nodes.size());
  std::vector<int> ends;  // of the subtrees that node i is in
  int i = 0;
  while (i < node_count) {
    while (!ends.empty() && ends.back() <= i) ends.pop_back();
    const typename AabbTree<S>::Node& node = tree.nodes[static_cast<std::size_t>(i)];
    const bool below = visit(node, static_cast<int>(ends.size()));
    if (!node.leaf()) ends.push_back(node.next);
    i = below || node.leaf() ? i + 1 : node.next;
  }
}

}  // namespace

template <class S>
AabbTreeRecord<S> AabbTree<S>::recorded_query(const Aabb<S>& box) const {
  AabbTreeRecord<S> record;
  walk(*this, [&](const Node& node, int depth) {
    const bool hit = overlaps(node.box, box);
    record.visits.push_back({node.box, depth, node.leaf(), hit});
    if (hit && node.leaf()) {
      const auto first = triangles.begin() + node.next;
      record.tested.insert(record.tested.end(), first, first + node.count);
      any_of_leaf(node, box, [&](int triangle) {
        record.candidates.push_back(triangle);
        return false;
      });
    }
    return hit;
  });
  return record;
}

template <class S>
void AabbTree<S>::refit(std::span<const Vec3<S>> vertices,
                        std::span<const std::array<int, 3>> corners) {
  assert(corners.size() == triangles.size());
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    boxes[k] = box_of(vertices, corners[static_cast<std::size_t>(triangles[k])]);
  }
  // Backwards: whatever is below a node stands behind it.
  for (std::size_t i = nodes.size(); i-- > 0;) {
    Node& node = nodes[i];
    node.box = {};
    if (node.leaf()) {
      for (int k = node.next; k < node.next + node.count; ++k) {
        node.box.include(boxes[static_cast<std::size_t>(k)]);
      }
    } else {
      const Node& left = nodes[i + 1];
      node.box =
          merged(left.box, nodes[left.leaf() ? i + 2 : static_cast<std::size_t>(left.next)].box);
    }
  }
}

template <class S>
int AabbTree<S>::depth() const {
  int deepest = 0;
  walk(*this, [&](const Node&, int depth) {
    deepest = std::max(deepest, depth + 1);
    return true;
  });
  return deepest;
}

template <class S>
Aabb<S> box_of(std::span<const Vec3<S>> vertices, const std::array<int, 3>& corners) {
  Aabb<S> box;
  for (const int corner : corners) box.include(vertices[static_cast<std::size_t>(corner)]);
  return box;
}

AabbTree<double> build_aabb_tree(std::span<const Aabb<double>> boxes) {
  return Builder(boxes).run();
}

template <class T>
AabbTree<T> aabb_tree_cast(const AabbTree<double>& tree) {
  AabbTree<T> cast;
  cast.nodes.reserve(tree.nodes.size());
  for (const AabbTree<double>::Node& node : tree.nodes) {
    cast.nodes.push_back({node.box.cast<T>(), node.next, node.count});
  }
  cast.triangles = tree.triangles;
  cast.boxes.reserve(tree.boxes.size());
  for (const Aabb<double>& box : tree.boxes) cast.boxes.push_back(box.cast<T>());
  return cast;
}

template struct AabbTree<float>;
template struct AabbTree<double>;
template Aabb<float> box_of(std::span<const Vec3<float>>, const std::array<int, 3>&);
template Aabb<double> box_of(std::span<const Vec3<double>>, const std::array<int, 3>&);
template AabbTree<float> aabb_tree_cast(const AabbTree<double>&);
template AabbTree<double> aabb_tree_cast(const AabbTree<double>&);

}  // namespace contactscope

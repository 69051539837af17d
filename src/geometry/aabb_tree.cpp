#include "geometry/aabb_tree.h"

#include "trace/pair.h"

namespace contactscope {
namespace {

template <class S> trace::Box traced(const Aabb<S>& box) {
  return {box.lower.template cast<double>(), box.upper.template cast<double>()};
}

// Wald 2007: 16 bins come within a few per cent of a full sweep; so few triangles get one each.
constexpr int kBins = 16;
// Most triangles of a leaf: to split four costs two tests of nodes and saves two of triangles.
constexpr int kMaxLeaf = 4;
// A binned split may cut off a single triangle at a time. From this depth on, split in halves: the
// remaining 32 levels suffice for any number of triangles that an int can count.
constexpr int kMaxSahDepth = kMaxAabbTreeDepth - 32;
// A part smaller than this, relative to the current unit, gets a unit of its own. Cuts are chosen
// with the 24 bits of a float; 14 of them are enough for 16 bins.
constexpr float kMinExtent = 0x1p-10F;

using Box = Aabb<double>;
using Lanes = lanes::Pack<float>;  // x, y, z and one unused lane
using Counts = lanes::Flags<float>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr Lanes kInfinite = {kInfinity, kInfinity, kInfinity, kInfinity};

float largest_of(const Lanes& lanes) { return std::max({lanes[0], lanes[1], lanes[2]}); }

/// A box in registers for choosing cuts: its lower corner and its negated upper corner, so that
/// growing takes two minima. Rounded to floats in the unit of its part; the final boxes are exact.
struct RoughBox {
  Lanes lower, minus_upper;  // uninitialized

  static RoughBox empty() { return {kInfinite, kInfinite}; }

  void include(const RoughBox& other) {
    lower = lanes::smaller(other.lower, lower);
    minus_upper = lanes::smaller(other.minus_upper, minus_upper);
  }
  Lanes twice_center() const { return lower - minus_upper; }
  Lanes extent() const { return -minus_upper - lower; }
};

/// A triangle during the build: its box, moved along with its position in the tree so that each
/// level reads memory forwards. The free lane of the lower corner stores the index as the bits of a
/// float from 1.0 upwards, which arithmetic on all lanes leaves harmless.
struct Item {
  RoughBox box;

  static float tag(int triangle) { return std::bit_cast<float>(triangle + kOne); }
  int triangle() const { return std::bit_cast<int>(float{box.lower[3]}) - kOne; }

  static constexpr int kOne = std::bit_cast<int>(1.0F);
};

/// Result of cutting a part of the tree in two.
struct Cut {
  std::size_t left_count = 0;  // 0: no cut was found
  RoughBox left = RoughBox::empty(), right = RoughBox::empty();
};

/// Triangles in bins along each axis; uninitialized.
struct Bins {
  using Row = std::array<RoughBox, kBins>;
  std::array<Row, 3> boxes;          // one row per axis
  std::array<Counts, kBins> counts;  // number of triangles, one lane per axis
  int size = kBins;

  void add(const Item& item, const Counts& bins) {
    for (int axis = 0; axis < 3; ++axis) {
      const int bin = bins[axis];
      at(at(boxes, axis), bin).include(item.box);
      ++at(counts, bin)[axis];
    }
  }
};

/// A cut between bins `bin` - 1 and `bin`.
struct BinCut {
  int axis = -1;  // -1: no cut was found
  int bin = 0;    // first bin of the right side
};

/// Half of the surface areas of three boxes, one lane per axis.
Lanes areas_of(const RoughBox& x, const RoughBox& y, const RoughBox& z) {
  const auto sides = [](const RoughBox& box) -> Lanes {
    const Lanes e = box.extent();
    return e * __builtin_shufflevector(e, e, 1, 2, 0, 3);
  };
  const Lanes sx = sides(x), sy = sides(y), sz = sides(z);
  const Lanes xy = __builtin_shufflevector(sx, sy, 0, 4, 1, 5);  // x0 y0 x1 y1
  const Lanes first = __builtin_shufflevector(xy, sz, 0, 1, 4, 4);
  const Lanes second = __builtin_shufflevector(xy, sz, 2, 3, 5, 5);
  const Lanes third =
      __builtin_shufflevector(__builtin_shufflevector(sx, sy, 2, 6, 2, 6), sz, 0, 1, 6, 6);
  return first + second + third;
}

Counts all_lanes(int count) { return Counts{count, count, count, count}; }

Lanes floats(const Counts& counts) { return __builtin_convertvector(counts, Lanes); }

/// The best cut between two bins, all axes in parallel; on each axis with `valid` the first and the
/// last bin must have triangles. Ties go to the first cut, x before y before z.
BinCut best_cut(const Bins& bins, const Counts& valid) {
  const auto boxes = [&](int axis, int bin) -> const RoughBox& {
    return at(at(bins.boxes, axis), bin);
  };
  std::array<Lanes, kBins> right_costs;  // of this bin and all after it; the first is not set
  std::array<RoughBox, 3> side;
  side.fill(RoughBox::empty());
  Counts count{};
  for (int k = bins.size - 1; k > 0; --k) {
    for (int axis = 0; axis < 3; ++axis) at(side, axis).include(boxes(axis, k));
    count += at(bins.counts, k);
    at(right_costs, k) = areas_of(side[0], side[1], side[2]) * floats(count);
  }
  side.fill(RoughBox::empty());
  count = all_lanes(0);
  Lanes best = kInfinite;
  Counts places{};
  for (int k = 1; k < bins.size; ++k) {
    for (int axis = 0; axis < 3; ++axis) at(side, axis).include(boxes(axis, k - 1));
    count += at(bins.counts, k - 1);
    const Lanes cost = areas_of(side[0], side[1], side[2]) * floats(count) + at(right_costs, k);
    const Counts better = (cost < best) & valid;
    best = better ? cost : best;
    places = better ? all_lanes(k) : places;
  }
  BinCut cut;
  float least = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    // Zero areas do not rank cuts.
    if (!(best[axis] < least && best[axis] > 0)) continue;
    least = best[axis];
    cut = {axis, places[axis]};
  }
  return cut;
}

/// Binned build with the surface area heuristic after Wald 2007, section 3. The cost of a cut is
/// the number of triangles on each side, weighted by the surface area of its box: the likelihood
/// that a query of the node reaches that side. Deviations: bins along all three axes instead of
/// only the longest (a better tree for three times the work), and a depth-first layout. Steps:
///   1. compute the box of the centres of all triangles;
///   2. sort centres into bins along each axis in one pass, and sweep the cuts between bins from
///      both sides; if there are no more triangles than bins, each bin gets one;
///   3. without a cut (all centres equal, or no areas), or too deep: split in halves by centre
///      along the longest axis, ties by index, so that equal triangles make a balanced tree;
///   4. recurse left, then right; at most kMaxLeaf triangles make a leaf;
///   5. finally compute the nodes' boxes from the original boxes of the triangles.
class Builder {
 public:
  explicit Builder(std::span<const Box> boxes) : boxes_(boxes), items_(boxes.size()) {
    assert(boxes.size() < (1U << 30));  // Item::tag
    for (int i = 0; i < count_of(items_); ++i) at(items_, i).box.lower[3] = Item::tag(i);
  }

  AabbTree<double> run() {
    tree_.nodes.reserve(boxes_.size());
    if (!boxes_.empty()) build(items_, measure(items_), 1);
    tree_.triangles = mapped(items_, &Item::triangle);
    tree_.boxes = mapped(tree_.triangles, [&](int triangle) { return at(boxes_, triangle); });
    tree_.fit_nodes();
    return std::move(tree_);
  }

 private:
  /// Recomputes the rough boxes of `items` in a unit in which their common box has length at most
  /// 1, and returns that common box.
  RoughBox measure(std::span<Item> items) const {
    Box all;
    for (const Item& item : items) all.include(at(boxes_, item.triangle()));
    const double largest = all.extent().maxCoeff();
    const double unit = largest > 0 ? largest : 1;
    const auto rough = [&](const Vec3d& corner) -> Lanes {
      const Vec3f numbers = ((corner - all.lower) / unit).cast<float>();
      return Lanes{numbers.x(), numbers.y(), numbers.z(), 0};
    };
    RoughBox bounds = RoughBox::empty();
    for (Item& item : items) {
      const Box& box = at(boxes_, item.triangle());
      const float tag = item.box.lower[3];
      item.box = {rough(box.lower), -rough(box.upper)};
      item.box.lower[3] = tag;
      bounds.include(item.box);
    }
    return bounds;
  }

  // `items`: a part of all; `bounds`: its box. At most kMaxAabbTreeDepth deep.
  void build(std::span<Item> items, RoughBox bounds, int depth) {
    assert(depth <= kMaxAabbTreeDepth);
    const std::size_t node = tree_.nodes.size();
    tree_.nodes.push_back({{}, static_cast<int>(items.data() - items_.data()), 0});
    if (items.size() <= kMaxLeaf) {
      tree_.nodes[node].count = count_of(items);
      std::ranges::sort(items, {}, &Item::triangle);
      return;
    }
    if (largest_of(bounds.extent()) < kMinExtent) bounds = measure(items);
    const Cut cut = split(items, depth);
    build(items.first(cut.left_count), cut.left, depth + 1);
    build(items.subspan(cut.left_count), cut.right, depth + 1);
    tree_.nodes[node].next = static_cast<int>(tree_.nodes.size());
  }

  // All functions below put the triangles of the left side first.

  static Cut split(std::span<Item> items, int depth) {
    Lanes lower = kInfinite, minus_upper = kInfinite;  // of the doubled centres
    for (const Item& item : items) {
      const Lanes center = item.box.twice_center();
      lower = lanes::smaller(center, lower);
      minus_upper = lanes::smaller(-center, minus_upper);
    }
    const Lanes extent = -minus_upper - lower;
    int longest = 0;
    for (const int other : {1, 2})
      if (extent[other] > extent[longest]) longest = other;
    Cut cut;
    if (depth < kMaxSahDepth && extent[longest] > 0)
      cut =
          items.size() <= kBins ? split_sorted(items, extent) : split_binned(items, lower, extent);
    return cut.left_count > 0 ? cut : split_halves(items, longest);
  }

  static Cut split_sorted(std::span<Item> items, const Lanes& extent) {
    const int count = count_of(items);
    // For each axis, the number of centres before each centre; ties in the order of items.
    std::array<Lanes, kBins> centers;
    std::array<Counts, kBins> ranks;
    Bins bins;
    bins.size = count;
    for (int i = 0; i < count; ++i) {
      at(centers, i) = items[static_cast<std::size_t>(i)].box.twice_center();
      at(ranks, i) = all_lanes(0);
      at(bins.counts, i) = all_lanes(1);
      for (int j = 0; j < i; ++j) {
        const Counts before = at(centers, i) < at(centers, j);  // -1 if true
        at(ranks, j) -= before;
        at(ranks, i) += before + 1;
      }
    }
    for (int i = 0; i < count; ++i)
      for (int axis = 0; axis < 3; ++axis)
        at(at(bins.boxes, axis), at(ranks, i)[axis]) = items[static_cast<std::size_t>(i)].box;
    const BinCut best = best_cut(bins, extent > 0);
    if (best.axis < 0) return {};
    const Bins::Row& sorted = at(bins.boxes, best.axis);
    for (int i = 0; i < count; ++i) items[static_cast<std::size_t>(i)].box = at(sorted, i);
    return cut_at(bins, best, static_cast<std::size_t>(best.bin));
  }

  static Cut split_binned(std::span<Item> items, const Lanes& lower, const Lanes& extent) {
    const Lanes bins_per_unit = extent > 0 ? static_cast<float>(kBins) / extent : Lanes{};
    constexpr Lanes kLast = {kBins - 1, kBins - 1, kBins - 1, 0};
    Bins bins;
    for (Bins::Row& row : bins.boxes) row.fill(RoughBox::empty());
    bins.counts.fill(all_lanes(0));
    for (const Item& item : items) {
      const Lanes place = (item.box.twice_center() - lower) * bins_per_unit;
      bins.add(item, __builtin_convertvector(lanes::smaller(place, kLast), Counts));
    }
    const BinCut best = best_cut(bins, extent > 0);
    if (best.axis < 0) return {};
    // In-place partition without unpredictable branches: each item is swapped to the end of the
    // left side, which grows only if the item belongs there.
    const float start = lower[best.axis], per_unit = bins_per_unit[best.axis];
    std::size_t left = 0;
    for (Item& item : items) {
      const float center = item.box.lower[best.axis] - item.box.minus_upper[best.axis];
      const bool goes_left = (center - start) * per_unit < static_cast<float>(best.bin);
      std::swap(item, items[left]);
      left += goes_left ? 1 : 0;
    }
    return cut_at(bins, best, left);
  }

  static Cut cut_at(const Bins& bins, const BinCut& at_bin, std::size_t left_count) {
    Cut cut;
    cut.left_count = left_count;
    const Bins::Row& row = at(bins.boxes, at_bin.axis);
    for (int k = 0; k < bins.size; ++k) (k < at_bin.bin ? cut.left : cut.right).include(at(row, k));
    return cut;
  }

  static Cut split_halves(std::span<Item> items, int axis) {
    Cut cut;
    cut.left_count = items.size() / 2;
    const auto half = items.begin() + static_cast<std::ptrdiff_t>(cut.left_count);
    std::ranges::nth_element(items, half, {}, [&](const Item& item) {
      return std::pair(item.box.twice_center()[axis], item.triangle());
    });
    for (std::size_t i = 0; i < items.size(); ++i)
      (i < cut.left_count ? cut.left : cut.right).include(items[i].box);
    return cut;
  }

  std::span<const Box> boxes_;
  std::vector<Item> items_;  // finally in tree order
  AabbTree<double> tree_;
};

}  // namespace

template <class S> trace::Tree AabbTree<S>::recorded_query(const Aabb<S>& box) const {
  trace::Tree record;
  record.box = traced(box);
  std::vector<int> ends;  // ends of the subtrees that contain node i
  for (int i = 0; i < count_of(nodes);) {
    while (!ends.empty() && ends.back() <= i) ends.pop_back();
    const Node& node = at(nodes, i);
    const bool hit = overlaps(node.box, box);
    record.visits.push_back({traced(node.box), count_of(ends), node.leaf(), hit});
    if (hit && node.leaf()) {
      any_of_leaf(node, OverlapsWith<S>(box), [&](int place) {
        record.candidates.push_back(at(triangles, place));
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
  fit_nodes();
}

template <class S> void AabbTree<S>::fit_nodes() {
  // Backwards: children come after their parent.
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

template <class S> double AabbTree<S>::expected_cost() const {
  double weighted = 0;
  for (const Node& node : nodes) {
    const int boxes_tested = node.leaf() ? node.count : 2;
    weighted += boxes_tested * surface_area(node.box.template cast<double>());
  }
  const double all = surface_area(bounds().template cast<double>());
  // All triangles on one line: assume that every query visits every box.
  return all > 0 ? weighted / all : static_cast<double>(nodes.size() + triangles.size());
}

template <class T> AabbTree<T> aabb_tree_cast(const AabbTree<double>& tree) {
  const auto cast = [](const AabbTree<double>::Node& node) -> typename AabbTree<T>::Node {
    return {node.box.cast<T>(), node.next, node.count};
  };
  return {mapped(tree.nodes, cast), tree.triangles, cast_each<Aabb<T>>(tree.boxes)};
}

template struct AabbTree<float>;
template struct AabbTree<double>;
template AabbTree<float> aabb_tree_cast(const AabbTree<double>&);
template AabbTree<double> aabb_tree_cast(const AabbTree<double>&);

AabbTree<double> build_aabb_tree(std::span<const Aabb<double>> boxes) {
  return Builder(boxes).run();
}

}  // namespace contactscope

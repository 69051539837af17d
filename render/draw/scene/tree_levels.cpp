#include "draw/scene/tree_levels.h"

#include "draw/scene/outlines.h"

namespace contactscope::draw {
namespace {

// Deeper nodes are darker.
constexpr std::array<Color, 4> kLevels = {rgb(0xF3F5F8), rgb(0xE6EAF0), rgb(0xD6DDE6),
                                          rgb(0xC5CFDB)};
// Nodes with boxes, by the number of such nodes around them, to show which node a box belongs to.
constexpr std::array<Color, 3> kBoxNodes = {rgb(0xFBF1D3), rgb(0xF2DA96), rgb(0xE3BF60)};
constexpr LineStyle kLevelBorder{1.0f, rgb(0x9AA3AE)}, kBoxNodeBorder{1.5f, rgb(0xB08D3C)};
constexpr Color kInVain = rgb(0xC2571A);
constexpr LineStyle kLink{3.5f, rgb(0x1F2328)}, kVainLink{3.5f, kInVain, true};
constexpr Swatch kBoxNodeSwatch{LegendGroup::Trees, 5, [](auto& pen) {
                                  pen.box(kBoxNodes[0], kBoxNodeBorder.color, kBoxNodeBorder.width);
                                }};
constexpr Swatch kNestedSwatch{
    LegendGroup::Trees, 5, [](auto& pen) {
      pen.box(kBoxNodes[0], kBoxNodeBorder.color, kBoxNodeBorder.width);
      const auto inner = {pen.at(10, -1), pen.at(20, -1), pen.at(20, 4), pen.at(10, 4)};
      pen.fill(inner, kBoxNodes[1]);
      pen.outline(inner, 1, kBoxNodeBorder.color);
    }};
constexpr Swatch kLevelsSwatch{LegendGroup::Trees, 7, [](auto& pen) {
                                 for (int i = 0; i < 3; ++i)
                                   pen.fill(pen.block(4.0 * i, 24 - 4.0 * i, 7 - 2.5 * i),
                                            kLevels[static_cast<std::size_t>(i)]);
                                 pen.outline(pen.block(0, 24), 1, kLevelBorder.color);
                               }};
constexpr Swatch kLinkSwatch{LegendGroup::Trees, 8, [](auto& pen) {
                               pen.line(pen.at(0, 0), pen.at(24, 0), kLink.width, kLink.color);
                             }};
constexpr Swatch kVainLinkSwatch{LegendGroup::Trees, 9, [](auto& pen) {
                                   for (const double from : {0.0, 9.0, 18.0})
                                     pen.line(pen.at(from, 0), pen.at(from + 6, 0), kVainLink.width,
                                              kInVain);
                                 }};

/// Index of each box's node: the smallest node that contains the box and is not full. Small boxes
/// choose first, because a large node may contain boxes of other nodes as well.
std::optional<std::vector<std::size_t>> nodes_of_boxes(const trace::BroadPhase& phase) {
  const auto in_order = [](const auto& list, const auto& box_of) {
    std::vector<std::size_t> order(list.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) {
      const trace::Box& box = box_of(list[i]);
      return (box.upper - box.lower).prod();
    });
    return order;
  };
  const auto box_of = [](const auto& each) -> const trace::Box& { return each.box; };
  const std::vector<std::size_t> nodes = in_order(phase.cells, box_of);
  std::vector<int> room;
  for (const trace::Cell& cell : phase.cells) room.push_back(cell.members);
  std::vector<std::size_t> found(phase.bounds.size());
  for (const std::size_t i : in_order(phase.bounds, box_of)) {
    const auto node = std::ranges::find_if(nodes, [&](std::size_t each) {
      return room[each] > 0 &&
             solid_box(phase.cells[each].box).contains(solid_box(phase.bounds[i].box));
    });
    if (node == nodes.end()) return std::nullopt;
    --room[*node];
    found[i] = *node;
  }
  return found;
}

/// Number of other nodes with boxes that contain it. 0 for leaves of a tree, which only overlap.
std::size_t nodes_around(const trace::BroadPhase& phase, const trace::Cell& cell) {
  if (phase.method == "tree") return 0;
  return static_cast<std::size_t>(std::ranges::count_if(phase.cells, [&](const trace::Cell& other) {
    return other.members > 0 && other.depth < cell.depth &&
           solid_box(other.box).contains(solid_box(cell.box));
  }));
}

/// The pairs of boxes for which `is_tested` is true.
template <class IsTested>
std::vector<TestedPair> pairs_where(const trace::BroadPhase& phase, const IsTested& is_tested) {
  std::vector<TestedPair> pairs;
  for (std::size_t i = 0; i < phase.bounds.size(); ++i) {
    for (std::size_t j = i + 1; j < phase.bounds.size(); ++j) {
      const trace::Bounds &a = phase.bounds[i], &b = phase.bounds[j];
      if (is_tested(a, b, i, j))
        pairs.push_back({&a, &b, solid_box(a.box).intersects(solid_box(b.box))});
    }
  }
  return pairs;
}

/// Pairs tested by a grid: too large boxes with all, and boxes of a cell with each other.
std::vector<TestedPair> find_tests_in_grid(const trace::BroadPhase& phase) {
  const auto is_in = [](const trace::Cell& cell, const trace::Bounds& bounds) {
    return !bounds.large && (bounds.box.lower.array() < cell.box.upper.array()).all() &&
           (bounds.box.upper.array() >= cell.box.lower.array()).all();
  };
  int tests = 0;
  std::vector<TestedPair> pairs = pairs_where(phase, [&](const auto& a, const auto& b, auto, auto) {
    const auto cells = std::ranges::count_if(
        phase.cells, [&](const trace::Cell& cell) { return is_in(cell, a) && is_in(cell, b); });
    const int of_pair = a.large || b.large ? 1 : static_cast<int>(cells);
    tests += of_pair;
    return of_pair > 0;
  });
  if (tests != phase.comparisons) pairs.clear();
  return pairs;
}

/// Pairs tested by a sweep: boxes that overlap along its axis.
std::vector<TestedPair> find_tests_in_sweep(const trace::BroadPhase& phase) {
  if (phase.cells.size() != 1 || phase.swept.empty()) return {};
  const int axis = phase.swept == "x" ? 0 : phase.swept == "y" ? 1 : 2;
  std::vector<TestedPair> pairs = pairs_where(phase, [&](const auto& a, const auto& b, auto, auto) {
    return a.box.lower[axis] <= b.box.upper[axis] && b.box.lower[axis] <= a.box.upper[axis];
  });
  if (count_of(pairs) != phase.comparisons) pairs.clear();
  return pairs;
}

Vec3d top_middle(const trace::Box& box, int up) {
  Vec3d at = 0.5 * (box.lower + box.upper);
  at[up] = box.upper[up];
  return at;
}

}  // namespace

std::vector<TestedPair> find_tests(const trace::BroadPhase& phase) {
  if (phase.method == "grid") return find_tests_in_grid(phase);
  if (phase.method == "columns") return find_tests_in_sweep(phase);
  const std::optional<std::vector<std::size_t>> nodes = nodes_of_boxes(phase);
  if (!nodes) return {};
  const bool is_octree = phase.method == "octree";
  std::vector<int> tests(phase.cells.size());
  std::vector<TestedPair> pairs =
      pairs_where(phase, [&](const auto& a, const auto&, std::size_t i, std::size_t j) {
        const trace::Box &a_node = phase.cells[(*nodes)[i]].box,
                         &b_node = phase.cells[(*nodes)[j]].box;
        // A tree compares leaves. An octree compares a box with the nodes of later boxes.
        const bool is_tested = solid_box(is_octree ? a.box : a_node).intersects(solid_box(b_node));
        tests[(*nodes)[j]] += is_tested;
        return is_tested;
      });
  bool as_counted = count_of(pairs) == phase.comparisons;
  for (std::size_t i = 0; is_octree && i < tests.size(); ++i)
    as_counted = as_counted && tests[i] == phase.cells[i].tests;
  if (!as_counted) pairs.clear();
  return pairs;
}

std::vector<trace::Cell> draw_levels(const trace::BroadPhase& phase, const Floor& floor,
                                     Sketch& sketch) {
  std::vector<trace::Cell> cells = phase.cells;
  // A small node of two leaves may lie within a larger leaf next to them, so leaves are drawn last.
  std::ranges::stable_sort(
      cells, {}, [](const trace::Cell& cell) { return std::pair(cell.members > 0, cell.depth); });
  for (const trace::Cell& cell : cells) {
    const std::vector<Vec3d> tile = floor.tile_of(cell.box);
    if (cell.members > 0) {
      const std::size_t around = std::min(nodes_around(phase, cell), kBoxNodes.size() - 1);
      sketch.face(tile, kBoxNodes[around], kBoxNodeBorder);
      continue;
    }
    const std::size_t level = std::min(static_cast<std::size_t>(cell.depth), kLevels.size() - 1);
    sketch.face(tile, kLevels[level], kLevelBorder);
    sketch.explain(kLevelsSwatch, "larger nodes, deeper ones darker");
  }
  return cells;
}

void explain_levels(const trace::BroadPhase& phase, bool counted, Sketch& sketch) {
  const bool nested = std::ranges::any_of(phase.cells, [&](const trace::Cell& cell) {
    return cell.members > 0 && nodes_around(phase, cell) > 0;
  });
  sketch.explain(nested ? kNestedSwatch : kBoxNodeSwatch,
                 phase.method == "tree" ? "leaf: a box and a margin around it"
                 : counted              ? "number: tests at a node"
                                        : "node, as far as its boxes reach");
}

void link_tested(const Scene& scene, Sketch& sketch) {
  const int up = Floor(scene).up();
  for (const TestedPair& pair : find_tests(*scene.frame.broad_phase)) {
    const Vec3d from = top_middle(pair.a->box, up), to = top_middle(pair.b->box, up);
    sketch.bordered_line(from, to, pair.overlaps ? kLink : kVainLink, 6.5f);
    for (const Vec3d& end : {from, to}) sketch.mark(MarkKind::Node, end, kLink.color);
    if (pair.overlaps)
      sketch.explain(kLinkSwatch, "pair that is tested");
    else
      sketch.explain(kVainLinkSwatch, "tested in vain: boxes do not overlap", 0.5 * (from + to));
  }
}

}  // namespace contactscope::draw

#include "draw/layers/layer.h"
#include "draw/scene/outlines.h"
#include "draw/scene/tree_levels.h"

/// Cells, columns or nodes of a broad phase as tiles on their floors; darker tiles cost more tests.
/// Tones are opaque and few. Where tiles overlap, the darkest is on top, so each visible tone is in
/// the legend. Tones are equal in all pictures, so that broad phases can be compared.
namespace contactscope::draw {
namespace {

struct Tone {
  int tests;  // lower limit
  Color color;
};
constexpr std::array<Tone, 3> kTones = {
    {{1, rgb(0xECEEF1)}, {10, rgb(0xD5D9DE)}, {100, rgb(0xC2C8CF)}}};
constexpr LineStyle kBorder{1.0f, rgb(0xB0B6BE)};
constexpr LineStyle kAbove{1.0f, rgb(0xB4B9C0)};
constexpr int kDeepest = 2;  // for nodes without boxes of their own
constexpr Color kTooLarge = rgb(0xEDE2C9);

/// White for a cell without tests.
Color tone_of(int tests) {
  Color tone = kWhite;
  for (const Tone& each : kTones)
    if (tests >= each.tests) tone = each.color;
  return tone;
}

// With the number of tones in the picture.
template <int Tones>
constexpr Swatch kTonesSwatch{LegendGroup::Trees, 5, [](auto& pen) {
                                constexpr double kWide = 24.0 / Tones;
                                for (int i = 0; i < Tones; ++i)
                                  pen.fill(pen.block(kWide * i, kWide * i + kWide),
                                           kTones[static_cast<std::size_t>(i)].color);
                                pen.outline(pen.block(0, 24), 1, kBorder.color);
                              }};
constexpr Swatch kAboveSwatch{LegendGroup::Trees, 6,
                              [](auto& pen) { pen.box(kWhite, kAbove.color, 1); }};
constexpr Swatch kLargeSwatch{LegendGroup::Trees, 8,
                              [](auto& pen) { pen.box(kTooLarge, kBorder.color, 1); }};

constexpr LineStyle kOnly{1.5f, rgb(0x8F969F)};
constexpr Swatch kOnlySwatch{LegendGroup::Trees, 7,
                             [](auto& pen) { pen.box(kWhite, kOnly.color, 1.5); }};

constexpr Color kSpan = rgb(0xF7EFD9), kSpanned = rgb(0xE6D29A);
constexpr LineStyle kBegins{5.0f, rgb(0x1F2328)};
constexpr Swatch kSpanSwatch{LegendGroup::Trees, 6, [](auto& pen) {
                               pen.box(kSpan, kSpan, 1);
                               pen.fill(pen.block(0, 24, 3), kSpanned);
                             }};
constexpr Swatch kBeginsSwatch{
    LegendGroup::Trees, 7,
    [](auto& pen) { pen.line(pen.at(12, -7), pen.at(12, 7), kBegins.width, kBegins.color); }};
constexpr float kCount = 18;        // size of the number in a tile, pixels
constexpr double kCountClear = 13;  // from its middle to the outline of a box, pixels
constexpr double kMinCounted = 20;  // pixels: narrower tiles have no number
constexpr double kSweptLength = 64, kBoxGap = 3.5, kColumnGap = 16;  // pixels

bool is_tree(const trace::BroadPhase& phase) {
  return phase.method == "tree" || phase.method == "octree";
}

/// In the most expensive column: first the box that is compared most often, then the boxes that it
/// is compared with, which begin along the axis before it ends.
struct Sweep {
  int axis = 0;
  trace::Box column;
  std::vector<const trace::Bounds*> boxes;
};

/// Nothing if the cells are not columns, or are swept along the up axis.
std::optional<Sweep> find_sweep(const trace::BroadPhase& phase, const Floor& floor) {
  Sweep sweep;
  sweep.axis = phase.swept == "x" ? 0 : phase.swept == "y" ? 1 : 2;
  if (phase.swept.empty() || sweep.axis == floor.up()) return std::nullopt;
  sweep.column = std::ranges::max_element(phase.cells, {}, &trace::Cell::tests)->box;
  const int across = floor.across(sweep.axis);
  std::vector<const trace::Bounds*> members;
  for (const trace::Bounds& bounds : phase.bounds) {
    if (bounds.box.upper[across] >= sweep.column.lower[across] &&
        bounds.box.lower[across] <= sweep.column.upper[across])
      members.push_back(&bounds);
  }
  const auto begin = [&](const trace::Bounds* it) { return it->box.lower[sweep.axis]; };
  std::ranges::stable_sort(members, {}, begin);
  for (auto first = members.begin(); first != members.end(); ++first) {
    const double its_end = (*first)->box.upper[sweep.axis];
    const auto end =
        std::find_if(first, members.end(), [&](const auto* it) { return begin(it) > its_end; });
    if (end - first > count_of(sweep.boxes)) sweep.boxes.assign(first, end);
  }
  if (sweep.boxes.size() < 2) return std::nullopt;
  return sweep;
}

void draw_span(const Sweep& sweep, const Floor& floor, Sketch& sketch) {
  const trace::Box& box = sweep.boxes.front()->box;
  trace::Box span = sweep.column;
  span.lower[sweep.axis] = box.lower[sweep.axis];
  span.upper[sweep.axis] = box.upper[sweep.axis];
  sketch.surfaces.push_back({floor.tile_of(span), kSpan});
  sketch.surfaces.push_back({floor.tile_of(box), kSpanned});
  sketch.explain(kSpanSwatch, "a box and its span");
}

/// Above the boxes: marks the start of each box that the sweep compares.
void mark_begins(const Scene& scene, const Sweep& sweep, const Floor& floor, Sketch& sketch) {
  const int compared = count_of(sweep.boxes) - 1, across = floor.across(sweep.axis);
  for (const trace::Bounds* bounds : sweep.boxes) {
    if (bounds == sweep.boxes.front()) continue;
    Vec3d from = bounds->box.lower;
    from[floor.up()] = bounds->box.upper[floor.up()];
    from[sweep.axis] -= kBoxGap * scene.scales.pixel / scene.camera.pixels_per_metre(from);
    Vec3d to = from;
    to[across] = bounds->box.upper[across];
    sketch.line(from, to, kBegins);
  }
  sketch.explain(kBeginsSwatch, "begins in the span, so tested: " + std::to_string(compared));
}

/// Above the boxes: tested pairs, or the tests of one step of a sweep.
void draw_begins(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.broad_phase || scene.frame.broad_phase->cells.empty()) return;
  const trace::BroadPhase& phase = *scene.frame.broad_phase;
  const Floor floor(scene);
  if ((is_tree(phase) || phase.method == "grid") && phase.bounds.size() <= kFewBoxes)
    return link_tested(scene, sketch);
  const std::optional<Sweep> sweep = find_sweep(phase, floor);
  if (!sweep) return;
  const bool linked = phase.bounds.size() <= kFewBoxes && !find_tests(phase).empty();
  if (linked)
    link_tested(scene, sketch);
  else
    mark_begins(scene, *sweep, floor, sketch);
  Vec3d from = floor.tile_of(sweep->column)[0];
  const Vec3d offset = Vec3d::Unit(sweep->axis);
  const double pixel = scene.scales.pixel / scene.camera.pixels_per_metre(from);
  const double metres = kSweptLength * pixel;
  from[floor.across(sweep->axis)] -= kColumnGap * pixel;
  sketch.arrow_to_scale(from, metres * offset, 2.5f, 10, kBegins.color);
  sketch.label(from + metres * offset, "swept along " + phase.swept, kBegins.color, 17, 8, offset);
}

/// Merges stacked cells of a grid into one tile with all their tests, so that the tiles add up to
/// the frame's total. Nodes of a tree stay separate.
std::vector<trace::Cell> stacked(const trace::BroadPhase& phase, const Floor& floor) {
  if (phase.method != "grid") return phase.cells;
  std::map<std::array<double, 4>, trace::Cell> stacks;
  for (const trace::Cell& cell : phase.cells) {
    const std::vector<Vec3d> tile = floor.tile_of(cell.box);
    const int x = floor.right(), y = floor.ahead();
    const auto [stack, is_new] =
        stacks.try_emplace({tile[0][x], tile[0][y], tile[2][x], tile[2][y]}, cell);
    if (is_new) continue;
    stack->second.tests += cell.tests;
    stack->second.members += cell.members;
  }
  std::vector<trace::Cell> cells;
  for (const auto& [tile, stack] : stacks) cells.push_back(stack);
  return cells;
}

constexpr LineStyle kLattice{1.0f, with_alpha(kShapeEdge, 0.16f)};
constexpr double kMaxLattice = 40;  // cells along a side; more would look like a grey area

/// Empty cells of the grid between occupied ones, which are not stored. They show that the grid is
/// unbounded, and which boxes are too large for its cells.
void draw_lattice(const trace::BroadPhase& phase, const Floor& floor, Sketch& sketch) {
  const trace::Box& cell = phase.cells.front().box;
  const double side = cell.upper[floor.right()] - cell.lower[floor.right()];
  if (!(side > 0)) return;
  const Vec3d corner = floor.tile_of(cell)[0];
  Eigen::AlignedBox3d around;
  for (const trace::Bounds& bounds : phase.bounds) around.extend(solid_box(bounds.box));
  const Vec3d first = ((around.min() - corner) / side).array().floor();
  const Vec3d last = ((around.max() - corner) / side).array().ceil();
  const int x = floor.right(), y = floor.ahead();
  if (!(std::max(last[x] - first[x], last[y] - first[y]) <= kMaxLattice)) return;
  for (const auto& [along, across] : {std::pair(x, y), std::pair(y, x)}) {
    for (double line = first[along]; line <= last[along]; ++line) {
      Vec3d from = corner, to = corner;
      from[along] = to[along] = corner[along] + line * side;
      from[across] += first[across] * side;
      to[across] += last[across] * side;
      sketch.line(from, to, kLattice);
    }
  }
}

/// Best place for a number in a tile, along the view's right and up axes: not on the tiles `above`
/// it, far from the outlines of boxes, and then at the lower left. Nothing if there is no room.
std::optional<Vec2d> place_in_tile(const Eigen::AlignedBox2d& tile,
                                   std::span<const Eigen::AlignedBox2d> above,
                                   const std::vector<Eigen::AlignedBox2d>& boxes, double pixel) {
  constexpr int kTried = 12;
  const Vec2d low = tile.min(), high = tile.max();
  const Vec2d margin = (0.5 * kCount * pixel * Vec2d(1.4, 1)).cwiseMin(0.5 * (high - low));
  std::optional<Vec2d> best;
  double most = 0;
  for (int row = 0; row <= kTried; ++row) {
    for (int column = 0; column <= kTried; ++column) {
      const Vec2d share(column / double(kTried), row / double(kTried));
      const Vec2d at = low + margin + share.cwiseProduct(high - low - 2 * margin);
      // Neighbouring tiles share the border and do not cover text next to it.
      const Eigen::AlignedBox2d text(at - 0.99 * margin, at + 0.99 * margin);
      if (std::ranges::any_of(above, [&](const auto& other) { return other.intersects(text); }))
        continue;
      double clear = kCountClear * pixel;
      for (const Eigen::AlignedBox2d& box : boxes) {
        const double inside = std::min((at - box.min()).minCoeff(), (box.max() - at).minCoeff());
        clear = std::min(clear, inside > 0 ? inside : box.exteriorDistance(at));
      }
      const double value = clear / pixel - 0.01 * (row + column);
      if (best && value <= most) continue;
      best = at;
      most = value;
    }
  }
  return best;
}

/// Writes the number of tests into each tile, or nothing if one has no room: a sum needs all
/// numbers. `cells`: in drawing order of their tiles. Returns whether numbers were written.
bool write_tests(const Scene& scene, const std::vector<trace::Cell>& cells, const Floor& floor,
                 Sketch& sketch) {
  const Vec3d right = scene.camera.right(), up = scene.camera.up();
  const auto flat = [&](const Vec3d& at) { return Vec2d(right.dot(at), up.dot(at)); };
  const auto seen = [&](const trace::Box& box) {
    Eigen::AlignedBox2d around;
    for (const Vec3d& corner : floor.tile_of(box)) around.extend(flat(corner));
    return around;
  };
  const double pixel = scene.scales.pixel / scene.camera.pixels_per_metre(cells.front().box.lower);
  std::vector<Eigen::AlignedBox2d> boxes;
  for (const trace::Bounds& bounds : scene.frame.broad_phase->bounds)
    boxes.push_back(seen(bounds.box));
  std::vector<Eigen::AlignedBox2d> tiles;
  for (const trace::Cell& cell : cells)
    if (cell.members > 0) tiles.push_back(seen(cell.box));
  std::span<const Eigen::AlignedBox2d> above = tiles;
  std::vector<std::pair<Vec2d, int>> numbers;
  for (const trace::Cell& cell : cells) {
    if (cell.members == 0) continue;
    const Eigen::AlignedBox2d& tile = above.front();
    above = above.subspan(1);
    if (cell.tests == 0) continue;
    const std::vector<Vec3d> corners = floor.tile_of(cell.box);
    for (const std::size_t neighbour : {1, 3})
      if (flat(corners[neighbour] - corners[0]).norm() < kMinCounted * pixel) return false;
    const std::optional<Vec2d> place = place_in_tile(tile, above, boxes, pixel);
    if (!place) return false;
    numbers.emplace_back(*place, cell.tests);
  }
  const Vec3d on_floor = floor.tile_of(cells.front().box)[0];
  for (const auto& [at, tests] : numbers) {
    const std::string text = std::to_string(tests);
    const double half = 0.5 * static_cast<double>(text_width(text, kCount, Weight::Bold)) * pixel;
    const Vec2d begin = at - Vec2d(half, 0) - flat(on_floor);  // the label extends to the right
    sketch.label(on_floor + begin.x() * right + begin.y() * up, text, kShapeEdge, kCount, 0, right);
  }
  return true;
}

void draw_cells(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.broad_phase || scene.frame.broad_phase->cells.empty()) return;
  const trace::BroadPhase& phase = *scene.frame.broad_phase;
  const Floor floor(scene);
  const auto tile_of = [&](const trace::Box& box) { return floor.tile_of(box); };
  const std::optional<Sweep> sweep = find_sweep(phase, floor);
  // A single tone has no information.
  if (phase.cells.size() == 1 && phase.cells.front().members > 0) {
    // With few boxes the cell would look like another box.
    if (phase.bounds.size() > kFewBoxes || !sweep)
      sketch.outline(tile_of(phase.cells.front().box), kOnly);
    if (sweep)
      draw_span(*sweep, floor, sketch);
    else
      sketch.explain(kOnlySwatch, "the only cell, of all boxes");
    return;
  }
  if (is_tree(phase) && phase.bounds.size() <= kFewBoxes) {
    const std::vector<trace::Cell> levels = draw_levels(phase, floor, sketch);
    const bool counted = phase.method == "octree" && find_tests(phase).empty() &&
                         write_tests(scene, levels, floor, sketch);
    return explain_levels(phase, counted, sketch);
  }
  if (phase.method == "grid") draw_lattice(phase, floor, sketch);
  std::vector<trace::Cell> cells = stacked(phase, floor);
  std::ranges::stable_sort(cells, {}, &trace::Cell::tests);
  for (const trace::Cell& cell : cells) {
    // Nodes without boxes of their own may overlap a dozen deep.
    if (cell.members == 0) {
      if (cell.depth > kDeepest) continue;
      sketch.outline(tile_of(cell.box), kAbove);
      sketch.explain(kAboveSwatch, "nodes around others, three levels");
    } else {
      sketch.face(tile_of(cell.box), tone_of(cell.tests), kBorder);
    }
  }
  bool any_large = false;
  for (const trace::Bounds& bounds : phase.bounds) {
    if (!bounds.large) continue;
    sketch.face(tile_of(bounds.box), kTooLarge, kBorder);
    any_large = true;
  }
  if (any_large) {
    const int in_cells = std::accumulate(
        cells.begin(), cells.end(), 0, [](int sum, const auto& cell) { return sum + cell.tests; });
    sketch.explain(kLargeSwatch, "too large for cells, tested with all: " +
                                     std::to_string(phase.comparisons - in_cells) + " tests");
  }
  if (sweep) draw_span(*sweep, floor, sketch);
  const int most = cells.back().tests;
  // A tree query tests nodes on all levels, and one test counts at several nodes.
  const bool adds_up = phase.method == "grid" || phase.method == "octree";
  const bool in_words = !adds_up || !write_tests(scene, cells, floor, sketch);
  const auto explain = [&](const Swatch& swatch, const std::string& tones) {
    const std::string where = is_tree(phase) ? "at a node" : "in a cell";
    sketch.explain(swatch,
                   in_words ? "tests " + where + ": up to 9" + tones : "number: tests " + where);
  };
  if (most >= kTones[2].tests)
    explain(kTonesSwatch<3>, ", up to 99, more");
  else if (most >= kTones[1].tests)
    explain(kTonesSwatch<2>, ", more");
  else if (most >= kTones[0].tests)
    explain(kTonesSwatch<1>, "");
}

}  // namespace

const LayerDrawing kCellsLayer{
    .needs = {&Stages::cells}, .beneath = draw_cells, .above = draw_begins};

}  // namespace contactscope::draw

#include <algorithm>
#include <array>
#include <string>

#include "draw/layers/layer.h"

/// The cells, columns or nodes into which a broad phase sorts boxes, as tiles on their floors: the
/// darker, the more tests they cost. Tones are opaque and few, and of tiles that lie over each other
/// the darkest is seen, so that a tone is one of the legend's; the same in every picture, so that
/// broad phases can be compared.
namespace contactscope::draw {
namespace {

struct Tone {
  int tests;  // from so many on
  Color color;
};
constexpr std::array<Tone, 3> kTones = {
    {{1, rgb(0xECEEF1)}, {10, rgb(0xD5D9DE)}, {100, rgb(0xC2C8CF)}}};
constexpr LineStyle kBorder{1.0f, rgb(0xB0B6BE)};
constexpr LineStyle kAbove{1.0f, with_alpha(kDropped, 0.5f)};
constexpr int kDeepest = 2;  // of nodes that only lie around others
constexpr Color kTooLarge = rgb(0xEDE2C9);

/// White of a cell without tests.
Color tone_of(int tests) {
  Color tone = kWhite;
  for (const Tone& each : kTones)
    if (tests >= each.tests) tone = each.color;
  return tone;
}

// So many tones as a picture has.
template <int Tones>
constexpr Swatch kTonesSwatch{
    LegendGroup::Trees, 5, [](auto& pen) {
      constexpr double kWide = 24.0 / Tones;
      for (int i = 0; i < Tones; ++i) {
        const double left = kWide * i;
        pen.fill(
            {pen.at(left, -7), pen.at(left + kWide, -7), pen.at(left + kWide, 7), pen.at(left, 7)},
            kTones[static_cast<std::size_t>(i)].color);
      }
      pen.outline({pen.at(0, -7), pen.at(24, -7), pen.at(24, 7), pen.at(0, 7)}, 1, kBorder.color);
    }};
constexpr Swatch kAboveSwatch{LegendGroup::Trees, 6,
                              [](auto& pen) { pen.box(kWhite, kAbove.color, 1); }};
constexpr Swatch kLargeSwatch{LegendGroup::Trees, 8,
                              [](auto& pen) { pen.box(kTooLarge, kBorder.color, 1); }};

constexpr LineStyle kOnly{1.5f, rgb(0x8F969F)};
constexpr Swatch kOnlySwatch{LegendGroup::Trees, 7,
                             [](auto& pen) { pen.box(kWhite, kOnly.color, 1.5); }};

void draw_cells(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.broad_phase || scene.frame.broad_phase->cells.empty()) return;
  const trace::BroadPhase& phase = *scene.frame.broad_phase;
  const int up = scene.header.up == "z" ? 2 : 1;
  const int right = up == 2 ? 0 : 2, ahead = up == 2 ? 1 : 0;  // right-handed with `up`
  // One floor for all, so that the order in which they are drawn is the one in which they lie.
  double floor = phase.cells.front().box.lower[up];
  for (const trace::Cell& cell : phase.cells) floor = std::min(floor, cell.box.lower[up]);
  const auto tile_of = [&](const trace::Box& box) {
    std::vector<Vec3d> tile(4, box.lower);
    tile[1][right] = tile[2][right] = box.upper[right];
    tile[2][ahead] = tile[3][ahead] = box.upper[ahead];
    for (Vec3d& corner : tile) corner[up] = floor;
    return tile;
  };
  // A single tone would tell nothing.
  if (phase.cells.size() == 1 && phase.cells.front().members > 0) {
    sketch.outline(tile_of(phase.cells.front().box), kOnly);
    sketch.explain(kOnlySwatch, phase.method == "columns" ? "the only column, of all boxes"
                                                          : "the only cell, of all boxes");
    return;
  }
  std::vector<trace::Cell> cells = phase.cells;
  std::ranges::stable_sort(cells, {}, &trace::Cell::tests);
  for (const trace::Cell& cell : cells) {
    // Nodes without boxes of their own lie over each other, a dozen deep.
    if (cell.members == 0) {
      if (cell.depth > kDeepest) continue;
      sketch.outline(tile_of(cell.box), kAbove);
      sketch.explain(kAboveSwatch, "nodes around others, three levels");
    } else {
      sketch.face(tile_of(cell.box), tone_of(cell.tests), kBorder);
    }
  }
  for (const trace::Bounds& bounds : phase.bounds) {
    if (!bounds.large) continue;
    sketch.face(tile_of(bounds.box), kTooLarge, kBorder);
    sketch.explain(kLargeSwatch, "too large for cells: tested with all");
  }
  const int most = cells.back().tests;
  const std::string where = phase.method == "tree" || phase.method == "octree"
                                ? "tests at a node: up to 9"
                                : "tests in a cell: up to 9";
  if (most >= kTones[2].tests)
    sketch.explain(kTonesSwatch<3>, where + ", up to 99, more");
  else if (most >= kTones[1].tests)
    sketch.explain(kTonesSwatch<2>, where + ", more");
  else if (most >= kTones[0].tests)
    sketch.explain(kTonesSwatch<1>, where);
}

}  // namespace

const LayerDrawing kCellsLayer{.needs = {&Stages::cells}, .beneath = draw_cells};

}  // namespace contactscope::draw

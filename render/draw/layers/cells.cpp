#include <algorithm>
#include <cmath>

#include "draw/layers/layer.h"

/// The cells, columns or nodes into which a broad phase sorts boxes, as tiles on their floors: the
/// darker, the more tests they cost. The same tone is the same cost in every picture, so that broad
/// phases can be compared.
namespace contactscope::draw {
namespace {

constexpr double kDarkestAt = 1000;  // tests
constexpr float kDarkest = 0.42f;    // alpha: what stands on it is still seen

/// By the number's digits: 1 is faint, a hundred twice as dark as ten.
float alpha_of(double tests) {
  const double share = std::log10(1 + tests) / std::log10(1 + kDarkestAt);
  return kDarkest * static_cast<float>(std::min(1.0, share));
}

constexpr Swatch kLargeSwatch{LegendGroup::Trees, 8, [](auto& pen) {
                                pen.box(with_alpha(kNormal, alpha_of(kDarkestAt)), kNormal, 2);
                              }};
template <int kTests>
void draw_swatch(const SwatchPen& pen) {
  pen.box(with_alpha(kNormal, alpha_of(kTests)), kDropped, 1);
}
constexpr Swatch kFewSwatch{LegendGroup::Trees, 5, draw_swatch<10>};
constexpr Swatch kManySwatch{LegendGroup::Trees, 6, draw_swatch<100>};
constexpr Swatch kMostSwatch{LegendGroup::Trees, 7, draw_swatch<1000>};

void draw_cells(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.broad_phase || scene.frame.broad_phase->cells.empty()) return;
  const int up = scene.header.up == "z" ? 2 : 1;
  const int right = up == 2 ? 0 : 2, ahead = up == 2 ? 1 : 0;  // right-handed with `up`
  const auto floor_of = [&](const trace::Box& box) {
    std::vector<Vec3d> floor(4, box.lower);
    floor[1][right] = floor[2][right] = box.upper[right];
    floor[2][ahead] = floor[3][ahead] = box.upper[ahead];
    return floor;
  };
  for (const trace::Cell& cell : scene.frame.broad_phase->cells) {
    // Nodes without boxes of their own lie over each other, a dozen deep.
    if (cell.members == 0)
      sketch.outline(floor_of(cell.box), {1.0f, with_alpha(kDropped, 0.3f)});
    else
      sketch.face(floor_of(cell.box), with_alpha(kNormal, alpha_of(cell.tests)), {1.0f, kDropped});
  }
  const auto others = static_cast<double>(scene.frame.poses.size() - 1);
  for (const trace::Bounds& bounds : scene.frame.broad_phase->bounds) {
    if (!bounds.large) continue;
    sketch.face(floor_of(bounds.box), with_alpha(kNormal, alpha_of(others)), {2.0f, kNormal});
    sketch.explain(kLargeSwatch, "too large for cells: tested with all");
  }
  sketch.explain(kFewSwatch, "cell of 10 tests of boxes");
  sketch.explain(kManySwatch, "of 100");
  sketch.explain(kMostSwatch, "of 1000 and more");
}

}  // namespace

const LayerDrawing kCellsLayer{.needs = {&Stages::cells}, .beneath = draw_cells};

}  // namespace contactscope::draw

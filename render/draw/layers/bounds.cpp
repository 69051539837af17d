#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/box_outline.h"

/// The boxes by which a broad phase chose the pairs.
namespace contactscope::draw {
namespace {

constexpr std::size_t kMostNamed = 12;  // boxes

constexpr Swatch kMeetingSwatch{LegendGroup::Trees, 3,
                                [](auto& pen) { pen.area(kSidePlane, 0, 2.5); }};
constexpr Swatch kAloneSwatch{LegendGroup::Trees, 4,
                              [](auto& pen) { pen.area(kDropped, 0, 1.5, true); }};

void draw_bounds(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.broad_phase) return;
  const auto meets = [&](const trace::Bounds& bounds) {
    return std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& pair) {
      return pair.a == bounds.name || pair.b == bounds.name;
    });
  };
  std::vector<trace::Bounds> all = scene.frame.broad_phase->bounds;
  const auto meeting = std::ranges::stable_partition(all, std::not_fn(meets)).begin();
  for (auto bounds = all.begin(); bounds != all.end(); ++bounds) {
    const bool alone = bounds < meeting;
    outline(bounds->box, {}, alone ? LineStyle{1.5f, kDropped, true} : LineStyle{2.5f, kSidePlane},
            sketch);
    if (all.size() <= kMostNamed) sketch.label(bounds->box.upper, bounds->name, kText, 14, 4);
    sketch.explain(
        alone ? kAloneSwatch : kMeetingSwatch,
        alone ? "box that meets no other" : "box that meets another: the pair is collided");
  }
}

}  // namespace

const LayerDrawing kBoundsLayer{.above = draw_bounds};

}  // namespace contactscope::draw

#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/box_outline.h"
#include "draw/scene/points.h"

/// The boxes by which a broad phase chose the pairs.
namespace contactscope::draw {
namespace {

constexpr std::size_t kMostNamed = 12;      // boxes
constexpr double kRoundingOfBounds = 1e-5;  // of a box's size; those of float are traced

constexpr Swatch kMeetingSwatch{LegendGroup::Trees, 3, [](auto& pen) { pen.area(kBox, 0, 2.5); }};
constexpr Swatch kShapeBoxSwatch{LegendGroup::Trees, 5, [](auto& pen) { pen.area(kBox, 0, 1.5); },
                                 kBox};
constexpr Swatch kAloneSwatch{LegendGroup::Trees, 4,
                              [](auto& pen) { pen.area(kDropped, 0, 1.5, true); }};

/// The upper corner, or the next one that is in no other box: a name there is clearly this box's.
Vec3d free_corner(const trace::Bounds& bounds, const std::vector<trace::Bounds>& all) {
  const trace::Box& box = bounds.box;
  const double rounding = kRoundingOfBounds * (box.upper - box.lower).norm();
  for (int bits = 7; bits >= 0; --bits) {
    const Vec3d corner((bits & 1 ? box.upper : box.lower).x(),
                       (bits & 2 ? box.upper : box.lower).y(),
                       (bits & 4 ? box.upper : box.lower).z());
    const auto holds = [&](const trace::Bounds& other) {
      return &other != &bounds && (corner - other.box.lower).minCoeff() >= -rounding &&
             (other.box.upper - corner).minCoeff() >= -rounding;
    };
    if (std::ranges::none_of(all, holds)) return corner;
  }
  return box.upper;
}

// What debuggers of engines draw first: the axis-aligned box of each shape.
void draw_boxes_of_shapes(const Scene& scene, Sketch& sketch) {
  for (const PlacedShape& shape : scene.shapes) {
    if (shape.traced().half_space || shape.vertices.empty()) continue;
    const Eigen::AlignedBox3d around = box_around(shape.vertices);
    const Vec3d radius = Vec3d::Constant(shape.traced().radius);
    const trace::Box box{around.min() - radius, around.max() + radius};
    outline(box, {}, {1.5f, kBox}, sketch);
    sketch.explain(kShapeBoxSwatch, "axis-aligned box of a shape", box.upper);
  }
}

void draw_bounds(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.broad_phase) return draw_boxes_of_shapes(scene, sketch);
  const auto meets = [&](const trace::Bounds& bounds) {
    return std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& pair) {
      return pair.a == bounds.name || pair.b == bounds.name;
    });
  };
  std::vector<trace::Bounds> all = scene.frame.broad_phase->bounds;
  const auto meeting = std::ranges::stable_partition(all, std::not_fn(meets)).begin();
  for (auto bounds = all.begin(); bounds != all.end(); ++bounds) {
    const bool alone = bounds < meeting;
    outline(bounds->box, {}, alone ? LineStyle{1.5f, kDropped, true} : LineStyle{2.5f, kBox},
            sketch);
    if (all.size() <= kMostNamed) {
      const Vec3d corner = free_corner(*bounds, all);
      sketch.label(corner, bounds->name, kText, 14, 4,
                   Vec3d(corner - 0.5 * (bounds->box.lower + bounds->box.upper)));
    }
    sketch.explain(
        alone ? kAloneSwatch : kMeetingSwatch,
        alone ? "box that meets no other" : "box that meets another: the pair is collided",
        bounds->box.upper);
  }
}

}  // namespace

const LayerDrawing kBoundsLayer{.above = draw_bounds};

}  // namespace contactscope::draw

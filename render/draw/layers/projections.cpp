#include "draw/layers/layer.h"
#include "draw/scene/points.h"

/// The survey's "Separating Axis Theorem", Fig. 3: both hulls projected onto the axis with the
/// largest separation. A gap between the intervals proves that the hulls are separated; without one
/// on any axis they overlap.
namespace contactscope::draw {
namespace {

// Pixels.
constexpr double kBeyondShapes = 46;  // from the shapes to the axis
constexpr double kBetweenBars = 11;   // from the interval of A to that of B
constexpr double kBeyondBars = 34;    // extension of the axis beyond the intervals
constexpr float kIntervalWidth = 7;
constexpr LineStyle kAxisLine{1.5f, kShapeEdge};
constexpr LineStyle kProjecting{1.2f, with_alpha(kQuietText, 0.9f), true};

constexpr Swatch kProjectingSwatch{LegendGroup::Axes, 7,
                                   [](auto& pen) { pen.dashes(1.2, kQuietText); }};
template <const Color& kInk>
constexpr Swatch kIntervalSwatch{
    LegendGroup::Axes, 8, [](auto& pen) { pen.level_line(0, 24, kIntervalWidth, kInk); }, kInk};

struct Interval {
  double from = 0, to = 0;  // metres along the axis
  // Points of the shape that are projected onto its ends; none for an interval that a test of bounds
  // computed, which may be wrong.
  std::optional<std::array<Vec3d, 2>> ends{};
};

struct Projection {
  Vec3d along;  // unit, from A to B
  Interval of_a, of_b;
};

Interval project(const PlacedShape& shape, const Vec3d& along) {
  const auto reach = [&](const Vec3d& p) { return along.dot(p); };
  const auto [low, high] = std::ranges::minmax_element(shape.vertices, {}, reach);
  const Vec3d beyond = shape.traced().radius * along;
  return {reach(*low - beyond), reach(*high + beyond), {{*low - beyond, *high + beyond}}};
}

/// Unit, from A to B; nothing without a separating axis test.
std::optional<Vec3d> axis_of(const trace::Pair& pair) {
  if (!pair.sat) return std::nullopt;
  const trace::Sat& sat = *pair.sat;
  if (sat.chosen == "face_a" && sat.face_a) return sat.face_a->normal;
  if (sat.chosen == "face_b" && sat.face_b) return sat.face_b->normal;
  if (sat.chosen == "edge_edge" && sat.edge) return sat.edge->normal;
  return std::nullopt;
}

/// The axis is that of the hulls' test, or the one that separates bounds.
std::optional<Projection> projection_of(const trace::Pair& pair, const PlacedShape& a,
                                        const PlacedShape& b) {
  if (const std::optional<Vec3d> along = axis_of(pair))
    return Projection{*along, project(a, *along), project(b, *along)};
  if (!pair.query || !pair.query->bounds_a || !pair.query->bounds_b) return std::nullopt;
  const auto axis =
      std::ranges::find_if(pair.query->axes, [](const auto& each) { return each.separates; });
  if (axis == pair.query->axes.end()) return std::nullopt;
  const double origin =
      0.5 * axis->direction.dot(pair.query->bounds_a->center + pair.query->bounds_b->center);
  const auto interval = [&](const std::array<double, 2>& ends) {
    return Interval{origin + ends[0], origin + ends[1]};
  };
  return Projection{axis->direction, interval(axis->interval_a), interval(axis->interval_b)};
}

void draw_projections(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape *a = scene.find(pair.a), *b = scene.find(pair.b);
  if (a == nullptr || b == nullptr || a->vertices.empty() || b->vertices.empty()) return;
  const std::optional<Projection> projection = projection_of(pair, *a, *b);
  if (!projection) return;
  const Vec3d& along = projection->along;
  const Interval &of_a = projection->of_a, &of_b = projection->of_b;
  const Vec3d middle = 0.5 * (center_of(a->vertices) + center_of(b->vertices));
  if (!scene.camera.sees(middle)) return;  // the legend omits it too
  // Below the shapes, or to the right if the axis is upright on the screen.
  Vec3d across = along.cross(scene.camera.to_eye(middle));
  if (across.norm() < 0.1) return;  // seen along the axis
  across.normalize();
  if (across.dot(scene.camera.right() - 2 * scene.camera.up()) < 0) across = -across;
  const double pixel = scene.scales.pixel / scene.camera.pixels_per_metre(middle);
  double reach = -1e300;
  for (const PlacedShape* shape : {a, b})
    for (const Vec3d& p : shape->vertices)
      reach = std::max(reach, across.dot(p) + shape->traced().radius);
  const auto place = [&](double metres, double pixels) -> Vec3d {
    return middle + (metres - along.dot(middle)) * along +
           (reach - across.dot(middle) + pixels * pixel) * across;
  };
  const double beyond = kBeyondBars * pixel;
  for (const bool is_a : {true, false}) {
    const Interval* const interval = is_a ? &of_a : &of_b;
    const double at_row = kBeyondShapes + (is_a ? 0 : kBetweenBars);
    if (const auto& ends = interval->ends) {
      sketch.line((*ends)[0], place(interval->from, at_row), kProjecting);
      sketch.line((*ends)[1], place(interval->to, at_row), kProjecting);
      sketch.explain(kProjectingSwatch, "projected onto the axis", (*ends)[1]);
    }
    sketch.line(place(interval->from, at_row), place(interval->to, at_row),
                {kIntervalWidth, is_a ? kArcOfA : kArcOfB});
    sketch.explain(is_a ? kIntervalSwatch<kArcOfA> : kIntervalSwatch<kArcOfB>,
                   is_a ? "interval of A" : "interval of B",
                   place(0.5 * (interval->from + interval->to), at_row));
  }
  const double under = kBeyondShapes + 2 * kBetweenBars;
  const double low = std::min(of_a.from, of_b.from) - beyond,
               high = std::max(of_a.to, of_b.to) + beyond;
  sketch.line(place(low, under), place(high, under), kAxisLine);
  const double separation = of_b.from - of_a.to;
  const Vec3d from = place(of_a.to, under), to = place(of_b.from, under);
  draw_measure(scene, separation > 0 ? Measured::Gap : Measured::Overlap, from, to, 3.5f, "",
               sketch);
  sketch.label(0.5 * (from + to),
               (separation > 0 ? "gap " : "overlap ") +
                   spell_length(std::abs(separation), scene.noise(pair), scene.scales.length),
               kAxisText, 18, 13, across);
}

}  // namespace

const LayerDrawing kProjectionsLayer{.needs = {&Stages::sat}, .search = draw_projections};

}  // namespace contactscope::draw

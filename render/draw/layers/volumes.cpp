#include "draw/layers/layer.h"
#include "draw/scene/outlines.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

/// Bounds that were queried instead of the shapes: boxes and balls in the colour of the answer.
namespace contactscope::draw {
namespace {

constexpr Swatch kFalsePositiveSwatch{LegendGroup::Trees, 5, [](auto& pen) {
                                        pen.area(answer_color(AnswerKind::FalsePositive), 0.1f, 3);
                                      }};
constexpr Swatch kOverlappingSwatch{
    LegendGroup::Trees, 6, [](auto& pen) { pen.area(answer_color(AnswerKind::Yes), 0, 2.5); }};
constexpr Swatch kBoundsSeparatedSwatch{
    LegendGroup::Trees, 7, [](auto& pen) { pen.area(answer_color(AnswerKind::No), 0, 1.5, true); }};

constexpr Swatch kMissedSwatch{LegendGroup::Trees, 8, [](auto& pen) {
                                 pen.area(answer_color(AnswerKind::Missed), 0, 2.5, true);
                               }};

constexpr Swatch kWidenedSwatch{LegendGroup::Trees, 9,
                                [](auto& pen) { pen.area(kMargin, 0, 1.5, true); }};

constexpr float kOriented = 2.5f;  // pixels, for a box that coincides with edges of another one

void explain(AnswerKind kind, Sketch& sketch) {
  if (kind == AnswerKind::No) return sketch.explain(kBoundsSeparatedSwatch, "bounds say no");
  if (kind == AnswerKind::Yes)
    return sketch.explain(kOverlappingSwatch, "bounds say yes, as the shapes do");
  if (kind == AnswerKind::FalsePositive)
    return sketch.explain(kFalsePositiveSwatch, "bounds say yes, the shapes no");
  sketch.explain(kMissedSwatch, "bounds say no, the shapes yes");
}

void draw_volume(const Scene& scene, const trace::Volume& volume, const LineStyle& style,
                 Sketch& sketch) {
  if (volume.half_extents) {
    const Vec3d& half = *volume.half_extents;
    outline({-half, half}, {volume.rotation.value_or(Quatd::Identity()), volume.center}, style,
            sketch);
    return;
  }
  if (!volume.radius) return;
  // The outline alone looks like a disc. A horizon makes it a ball.
  const RoundBody ball{{volume.center}, *volume.radius};
  sketch.curves.push_back({ball.outline(scene.camera), style, true});
  const Vec3d up = up_axis(scene.header), x = any_perpendicular(up), y = up.cross(x);
  const std::vector<Vec3d> horizon = mapped(circle(96), [&](const Vec2d& at) -> Vec3d {
    return volume.center + *volume.radius * (at.x() * x + at.y() * y);
  });
  LineStyle faint = style;
  faint.width *= 0.4f;
  sketch.curves.push_back({horizon, faint, true});
}

/// Whether other pairs of the same shapes have queries of bounds too.
bool is_one_of_several(const Scene& scene, const trace::Pair& pair) {
  return std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& other) {
    return &other != &pair && other.a == pair.a && other.b == pair.b && other.query &&
           !other.query->bounds.empty();
  });
}

/// Whether this box equals an axis-aligned box of the same shapes, which is drawn already.
bool is_aligned_box(const Scene& scene, const trace::Pair& pair, const trace::Volume& box) {
  const auto same = [&](const std::optional<trace::Volume>& other) {
    return other && other->half_extents &&
           (other->center - box.center).norm() <= 1e-6 * box.half_extents->norm() &&
           box.rotation.value_or(Quatd::Identity()).isApprox(Quatd::Identity(), 1e-6) &&
           other->half_extents->isApprox(*box.half_extents, 1e-6);
  };
  return std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& other) {
    return other.a == pair.a && other.b == pair.b && other.query && other.query->bounds == "aabb" &&
           (same(other.query->bounds_a) || same(other.query->bounds_b));
  });
}

void name_volume(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (pair.label.empty()) return;
  const trace::Volume& volume = *pair.query->bounds_a;
  // At the upper left: a corner of axis-aligned boxes, a side of oriented ones; for balls below.
  const Vec3d offset = scene.camera.up() - scene.camera.right();
  Vec3d at = volume.center;
  for (const Vec3d& corner : extent_points(volume))
    if (volume.half_extents && offset.dot(corner) > offset.dot(at)) at = corner;
  if (volume.radius) at -= *volume.radius * (scene.camera.up() + scene.camera.right()).normalized();
  sketch.label(at, label_with_answer(pair), answer_color(answer_kind(pair)), 16, 8,
               Vec3d(at - volume.center));
}

void draw_volumes(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.query || !pair.query->bounds_a || !pair.query->bounds_b) return;
  const AnswerKind kind = answer_kind(pair);
  const bool no = kind == AnswerKind::No;
  const LineStyle style{no ? 1.5f : 2.5f, answer_color(kind), no || kind == AnswerKind::Missed};
  const bool several = is_one_of_several(scene, pair);
  for (const trace::Volume& volume : {*pair.query->bounds_a, *pair.query->bounds_b}) {
    const bool oriented = several && volume.half_extents && pair.query->bounds == "obb";
    if (oriented && is_aligned_box(scene, pair, volume)) continue;
    LineStyle outlined = style;
    // The oriented box of a box coincides with its edges and must stay visible.
    if (oriented) outlined.width = kOriented;
    // White between the dashes, because the edges would show there.
    if (style.dashed && volume.half_extents && pair.query->bounds == "obb")
      draw_volume(scene, volume, {outlined.width + 1.5f, kWhite}, sketch);
    draw_volume(scene, volume, outlined, sketch);
    if (!(pair.query->tolerance > 0)) continue;
    trace::Volume wide = volume;
    const double half = 0.5 * pair.query->tolerance;
    if (wide.half_extents) wide.half_extents->array() += half;
    if (wide.radius) *wide.radius += half;
    draw_volume(scene, wide, {1.5f, kMargin, true}, sketch);
    sketch.explain(kWidenedSwatch, "half of the tolerance: " + spell_length(half), wide.center);
  }
  explain(kind, sketch);
  if (several || pair.query->bounds_a->radius) name_volume(scene, pair, sketch);
}

// Answer of a distance or depth query: closest or deepest points and the distance between them.

constexpr double kMinOfAnswer = 14;  // pixels: at less, dots hide the measure

constexpr Swatch kPointsSwatch{LegendGroup::Axes, 4, [](auto& pen) { pen.dot(0, 4.0, kAxisText); }};

bool is_near(const std::optional<Vec3d>& p, const std::optional<Vec3d>& q) {
  return p && q && (*p - *q).norm() <= 1e-6 * (p->norm() + q->norm());
}

/// Whether two queries have the same pair of points, in either order of shapes.
bool is_same_measure(const trace::Pair& pair, const trace::Pair& other) {
  const trace::Query &one = *pair.query, &two = *other.query;
  // If faces are equally deep all over, methods find different points. One measure suffices.
  const bool same_length = std::abs(*one.gap - *two.gap) <= 1e-5 * std::abs(*one.gap);
  if (other.a == pair.a && other.b == pair.b)
    return same_length || (is_near(one.point_a, two.point_a) && is_near(one.point_b, two.point_b));
  return other.a == pair.b && other.b == pair.a && is_near(one.point_a, two.point_b) &&
         is_near(one.point_b, two.point_a);
}

/// Whether another query is shorter for one of these shapes. A user who queries several distances
/// of a shape looks for the nearest.
bool is_nearer_elsewhere(const Scene& scene, const trace::Pair& pair) {
  const double gap = *pair.query->gap;
  return std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& other) {
    const int shared =
        (other.a == pair.a || other.a == pair.b) + (other.b == pair.a || other.b == pair.b);
    return shared == 1 && other.query && other.query->gap &&
           *other.query->gap < gap - 1e-5 * std::abs(gap);
  });
}

void draw_answer(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.query || !pair.query->gap || !pair.query->point_a || !pair.query->point_b) return;
  const trace::Query& query = *pair.query;
  // A query with the same points has drawn them already.
  for (const trace::Pair* other = scene.frame.pairs.data(); other != &pair; ++other)
    if (other->query && other->query->gap && is_same_measure(pair, *other)) return;
  const bool separated = *query.gap >= 0;
  const Vec3d &from = *query.point_a, &to = *query.point_b;
  const bool touches = from == to || *query.gap == 0;  // otherwise rounding would be measured
  const std::optional<float> pixels = seen_distance(scene.camera, from, to);
  if (touches || (pixels && *pixels >= kMinOfAnswer * scene.scales.pixel)) {
    for (const Vec3d& point : {from, to}) sketch.mark(MarkKind::Node, point, kAxisText);
    // Otherwise the arrow covers the points.
    if (touches)
      sketch.explain(kPointsSwatch, separated ? "closest points" : "deepest points", from);
  }
  if (touches) return;
  const bool quiet = separated && is_nearer_elsewhere(scene, pair);
  draw_measure(scene, separated ? Measured::Gap : Measured::Overlap, from, to, quiet ? 1.5f : 3, "",
               sketch);
  sketch
      .label(0.5 * (from + to),
             spell_separation(*query.gap, scene.noise(pair), scene.scales.length), kAxisText, 17,
             14, scene.camera.right())
      .bold = !quiet;
}

}  // namespace

const LayerDrawing kVolumesLayer{.needs = {&Stages::query}, .search = draw_volumes};

const LayerDrawing kAnswerLayer{.search = draw_answer};

}  // namespace contactscope::draw

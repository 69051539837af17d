#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/layers/layer.h"
#include "draw/scene/answers.h"
#include "draw/scene/box_outline.h"
#include "draw/scene/solid.h"

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

constexpr float kOriented = 2.5f;  // pixels, for a box that coincides with edges of another one

void explain(AnswerKind kind, Sketch& sketch) {
  switch (kind) {
    case AnswerKind::No:
      return sketch.explain(kBoundsSeparatedSwatch, "bounds say no");
    case AnswerKind::Yes:
      return sketch.explain(kOverlappingSwatch, "bounds say yes, as the shapes do");
    case AnswerKind::FalsePositive:
      return sketch.explain(kFalsePositiveSwatch, "bounds say yes, the shapes no");
    case AnswerKind::Missed:
      return sketch.explain(kMissedSwatch, "bounds say no, the shapes yes");
  }
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
  constexpr int kSteps = 96;
  std::vector<Vec3d> horizon;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSteps;
    horizon.push_back(volume.center + *volume.radius * (std::cos(angle) * x + std::sin(angle) * y));
  }
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

/// Labels the bounds.
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
  }
  explain(kind, sketch);
  if (several || pair.query->bounds_a->radius) name_volume(scene, pair, sketch);
}

}  // namespace

const LayerDrawing kVolumesLayer{.needs = {&Stages::query}, .search = draw_volumes};

}  // namespace contactscope::draw

#include <algorithm>
#include <limits>

#include "draw/layers/layer.h"
#include "draw/scene/answers.h"
#include "draw/scene/quantity.h"

/// The most informative axis of an overlap test, as an arrow between the bounds; for a cross
/// product also the two edges. It is the axis that separates, or a cross product so short that
/// rounding determines its direction, or the one with the largest gap (Gottschalk, Lin and Manocha
/// 1996, "OBBTree"; the survey's "Oriented Bounding Box").
namespace contactscope::draw {
namespace {

constexpr float kArrow = 90;     // pixels
constexpr double kShort = 0.01;  // sine of the angle between two edges; a smaller one is labelled

constexpr Swatch kSeparatingSwatch{LegendGroup::Axes, 5,
                                   [](auto& pen) { pen.arrow(3.5, 9, kAxis); }};
constexpr Swatch kTestedSwatch{LegendGroup::Axes, 6,
                               [](auto& pen) { pen.arrow(2, 9, kShapeEdge); }};
constexpr Swatch kSkippedSwatch{LegendGroup::Axes, 7,
                                [](auto& pen) { pen.open_arrow(1.5, kDropped); }};

bool is_short(const trace::TestedAxis& axis) {
  return axis.kind == "edges" && axis.length < kShort && !axis.direction.isZero(0);
}

/// Share of both boxes' reach by which the gap along a cross product must exceed the gap along a
/// face: it may be the same axis with rounding.
constexpr double kRounding = 16 * std::numeric_limits<float>::epsilon();

bool is_larger(const trace::TestedAxis& axis, const trace::TestedAxis& than) {
  const bool is_edge_over_face = axis.kind == "edges" && than.kind != "edges";
  const double reach = axis.interval_b[1] - axis.interval_a[0];
  return axis.gap > than.gap + (is_edge_over_face ? kRounding * reach : 0);
}

/// The separating axis; otherwise the short cross product with the largest gap; otherwise the
/// largest gap of all axes that were not skipped. Null if there is none.
const trace::TestedAxis* worth_a_look(const trace::Query& query) {
  const auto largest = [&](auto&& counts) {
    const trace::TestedAxis* found = nullptr;
    for (const trace::TestedAxis& axis : query.axes)
      if (!axis.direction.isZero(0) && counts(axis) &&
          (found == nullptr || is_larger(axis, *found)))
        found = &axis;
    return found;
  };
  const trace::TestedAxis* axis = largest([](const auto& one) { return one.separates; });
  if (axis == nullptr) axis = largest(is_short);
  return axis ? axis : largest([](const auto& one) { return !one.skipped; });
}

/// The extent point of a volume that is nearest to the other's centre.
Vec3d end_towards(const trace::Volume& volume, const trace::Volume& other) {
  const std::vector<Vec3d> ends = extent_points(volume);
  return *std::ranges::min_element(
      ends, {}, [&](const Vec3d& end) { return (end - other.center).squaredNorm(); });
}

void draw_edge(const trace::Volume& box, int k, const Vec3d& end, Sketch& sketch) {
  if (!box.half_extents || k < 0 || k > 2) return;
  const Vec3d offset = box.rotation.value_or(Quatd::Identity()) * Vec3d::Unit(k);
  const double side = offset.dot(end - box.center) > 0 ? -2 : 2;
  sketch.line(end, end + side * (*box.half_extents)[k] * offset, {4, kAxis});
}

void draw_tested_axes(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.query || !pair.query->bounds_a || !pair.query->bounds_b) return;
  const trace::Query& query = *pair.query;
  const Vec3d end_a = end_towards(*query.bounds_a, *query.bounds_b);
  const Vec3d end_b = end_towards(*query.bounds_b, *query.bounds_a);
  const Vec3d middle = 0.5 * (end_a + end_b);
  if (!scene.camera.sees(middle)) return;  // the legend omits it too
  if (const trace::TestedAxis* axis = worth_a_look(query)) {
    if (axis->kind == "edges") {
      draw_edge(*query.bounds_a, axis->a, end_a, sketch);
      draw_edge(*query.bounds_b, axis->b, end_b, sketch);
      sketch.explain(kDecidingEdgesSwatch, "edges that make the axis", end_a);
    }
    const Color color = axis->separates ? kAxis : axis->skipped ? kDropped : kShapeEdge;
    const float width = axis->separates ? 3.5f : axis->skipped ? 1.5f : 2;
    sketch.arrow(middle, axis->direction, kArrow, width, 11, color).open = axis->skipped;
    const std::string text =
        spell_axis(query, *axis) +
        (is_short(*axis) ? ", length " + spell_number(axis->length, 2) : std::string());
    const double metres = kArrow * scene.scales.pixel / scene.camera.pixels_per_metre(middle);
    sketch.label(middle + metres * axis->direction, text, axis->separates ? kAxisText : kQuietText,
                 16, 8, axis->direction);
    sketch.explain(axis->separates ? kSeparatingSwatch
                   : axis->skipped ? kSkippedSwatch
                                   : kTestedSwatch,
                   axis->separates   ? is_short(*axis) ? "cross product of two edges, separates"
                                                       : "axis that separates"
                   : axis->skipped   ? "cross product of two edges, skipped"
                   : is_short(*axis) ? "cross product of two edges"
                                     : "axis without a gap");
  }
}

}  // namespace

const LayerDrawing kTestedAxesLayer{.needs = {&Stages::query}, .search = draw_tested_axes};

}  // namespace contactscope::draw

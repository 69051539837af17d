#include <algorithm>
#include <cmath>
#include <optional>

#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

constexpr double kLeastMeasure = 26;  // pixels: two heads and a bit of line between them
constexpr double kOuterArrow = 24;    // pixels

struct Ends {
  Vec3d a, b;  // world, on the surfaces of A and of B
};

// The middle of all vertices that are as far along `direction` as the farthest one.
std::optional<Vec3d> farthest(const PlacedShape& shape, const Vec3d& direction) {
  if (shape.vertices.empty()) return std::nullopt;
  double most = -1e300;
  for (const Vec3d& v : shape.vertices) most = std::max(most, direction.dot(v));
  Vec3d sum = Vec3d::Zero();
  int count = 0;
  for (const Vec3d& v : shape.vertices) {
    if (most - direction.dot(v) > 1e-5 * shape.mesh->radius) continue;
    sum += v;
    ++count;
  }
  return sum / count + shape.mesh->shape->radius * direction;
}

// Along a known normal the gap is the pair's separation: from the shape whose vertex it was
// measured to.
std::optional<Ends> along(const PlacedShape& a, const PlacedShape& b, const Vec3d& normal,
                          bool from_b, double gap) {
  if (from_b) {
    const std::optional<Vec3d> on_a = farthest(a, normal);
    if (!on_a) return std::nullopt;
    return Ends{*on_a, *on_a + gap * normal};
  }
  const std::optional<Vec3d> on_b = farthest(b, -normal);
  if (!on_b) return std::nullopt;
  return Ends{*on_b - gap * normal, *on_b};
}

bool is_sphere(const PlacedShape& shape) {
  return shape.mesh->shape->radius > 0 && shape.vertices.size() == 1;
}

// What the trace says about where the shapes are nearest to each other, or what kept them apart.
std::optional<Ends> gap_of(const trace::Pair& pair, const PlacedShape& a, const PlacedShape& b) {
  const double gap = pair.separation;
  if (pair.gjk && pair.gjk->status == "separated" && pair.gjk->distance > 0) {
    const Vec3d normal = (pair.gjk->point_b - pair.gjk->point_a) / pair.gjk->distance;
    const double margin_a = pair.incremental ? pair.incremental->margin_a : 0;
    const double margin_b = pair.incremental ? pair.incremental->margin_b : 0;
    const double round_a = a.mesh->shape->radius, round_b = b.mesh->shape->radius;
    return Ends{pair.gjk->point_a + (round_a > 0 ? round_a : margin_a) * normal,
                pair.gjk->point_b - (round_b > 0 ? round_b : margin_b) * normal};
  }
  for (const bool of_a : {true, false}) {
    const PlacedShape& plane = of_a ? a : b;
    if (!plane.mesh->shape->half_space) continue;
    const Vec3d outward = plane.pose.rotate(plane.mesh->shape->half_space->normal);
    return along(a, b, of_a ? outward : Vec3d(-outward), !of_a, gap);
  }
  if (is_sphere(a) && is_sphere(b)) {
    const Vec3d way = b.vertices[0] - a.vertices[0];
    if (way.isZero()) return std::nullopt;
    return along(a, b, way.normalized(), true, gap);
  }
  if (pair.sat) {
    const trace::Sat& sat = *pair.sat;
    if (sat.chosen == "face_a" && sat.face_a) return along(a, b, sat.face_a->normal, false, gap);
    if (sat.chosen == "face_b" && sat.face_b) return along(a, b, sat.face_b->normal, true, gap);
    if (sat.chosen == "edge_edge" && sat.edge)
      return Ends{sat.edge->point_b - sat.edge->separation * sat.edge->normal, sat.edge->point_b};
  }
  if (pair.cache && pair.cache->hit && pair.cache->normal && pair.cache->axis != "edge_edge") {
    return along(a, b, *pair.cache->normal, pair.cache->axis == "face_b", gap);
  }
  return std::nullopt;
}

}  // namespace

void draw_measure(const Scene& scene, const Vec3d& from, const Vec3d& to, float width,
                  const std::string& text, Sketch& sketch) {
  const std::optional<Point2> a = scene.camera.project(from), b = scene.camera.project(to);
  if (!a || !b) return;
  Arrow arrow;
  arrow.width = width;
  arrow.head = 10;
  arrow.color = kAxis;
  const double seen = std::hypot(b->x - a->x, b->y - a->y);
  const double pixel = scene.scales.pixel;
  if (seen >= kLeastMeasure * pixel || seen <= 0) {
    arrow.from = from;
    arrow.to = to;
    arrow.double_headed = true;
    sketch.arrows.push_back(arrow);
    sketch.explain(LegendKind::Axis, text);
    return;
  }
  // As drawings measure what is narrow. The arrows are as long on the screen as if seen squarely.
  const Vec3d outward = (from - to) * (kOuterArrow * pixel / seen);
  for (const auto& [tip, way] : {std::pair{from, outward}, {to, Vec3d(-outward)}}) {
    arrow.from = tip + way;
    arrow.to = tip;
    sketch.arrows.push_back(arrow);
  }
  sketch.explain(LegendKind::NarrowAxis, text);
}

void draw_labelled_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, double metres,
                       float clearance, const Vec3d& aside, Sketch& sketch) {
  draw_measure(scene, from, to, 3, "gap", sketch);
  sketch.labels.push_back({.at = 0.5 * (from + to),
                           .text = spell_length(metres),
                           .color = kAxisText,
                           .size = 17,
                           .bold = true,
                           .clearance = clearance,
                           .direction = aside});
}

// Gregorius 2015, "Sphere vs Sphere": all follows from the line between the centres.
void draw_gap(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape* a = scene.find(pair.a);
  const PlacedShape* b = scene.find(pair.b);
  if (a == nullptr || b == nullptr) return;
  if (is_sphere(*a) && is_sphere(*b) && !a->vertices[0].isApprox(b->vertices[0], 1e-6)) {
    sketch.lines.push_back(
        {a->vertices[0], b->vertices[0], {1.2f, with_alpha(kShapeEdge, 0.8f), true}});
    sketch.explain(LegendKind::LineOfCenters, "line between the centres");
  }
  if (pair.state != "separated" || !(pair.separation > 0)) return;
  const std::optional<Ends> ends = gap_of(pair, *a, *b);
  if (!ends) return;
  draw_labelled_gap(scene, ends->a, ends->b, pair.separation, 16, scene.camera.right(), sketch);
}

}  // namespace contactscope::draw

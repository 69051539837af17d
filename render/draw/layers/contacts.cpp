#include <algorithm>
#include <cmath>

#include "draw/layers/layer.h"
#include "draw/scene/arrows.h"
#include "draw/scene/mesh_surface.h"
#include "draw/scene/pair_points.h"
#include "draw/scene/quantity.h"
#include "draw/scene/swatches.h"

/// Gregorius 2015, "Contact Points" and "Contact Manifolds"; of shapes that are apart how far, and
/// where.
namespace contactscope::draw {
namespace {

constexpr Swatch kOneShotSwatch{LegendGroup::Points, 4, [](auto& pen) {
                                  pen.whisker(2.5, kContact);
                                  draw_square(pen.middle(), pen.px(4.2), kContact, pen.drawing());
                                }};
constexpr Swatch kApartSwatch{LegendGroup::Points, 10, [](auto& pen) {
                                pen.whisker(1.5, kContact);
                                pen.dot(0, 4.8, kWhite);
                                pen.dot(0, 4.8, with_alpha(kContact, 0.3f));
                                pen.dot(3.7, 4.8, kContact);
                              }};
constexpr Swatch kLineOfCentersSwatch{LegendGroup::Axes, 4,
                                      [](auto& pen) { pen.dashes(1.2, kShapeEdge); }};

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
  const std::optional<Vec3d> found = from_b ? farthest(a, normal) : farthest(b, Vec3d(-normal));
  if (!found) return std::nullopt;
  return from_b ? Ends{*found, *found + gap * normal} : Ends{*found - gap * normal, *found};
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

/// How a point is drawn. Points that have an age are drawn by it, with the way between the places
/// that met. Beside them a filled dot means a new point, which those of a one-shot manifold all are
/// and none is.
MarkKind mark_of(const Scene& scene, const trace::Point& point) {
  if (stands_off(point, scene.scales)) return MarkKind::Apart;
  return scene.shows(Layer::Persistent) ? MarkKind::Square : MarkKind::Dot;
}

// Between the two surfaces where the gap is known and no other layer measures it.
std::optional<Ends> measured_gap(const Scene& scene, const trace::Pair& pair) {
  if (pair.state != "separated" || !(pair.separation > 0)) return std::nullopt;
  const PlacedShape* a = scene.find(pair.a);
  const PlacedShape* b = scene.find(pair.b);
  return a == nullptr || b == nullptr ? std::nullopt : gap_of(pair, *a, *b);
}

// Gregorius 2015, "Sphere vs Sphere": all follows from the line between the centres.
std::optional<Ends> line_of_centers(const Scene& scene, const trace::Pair& pair) {
  const PlacedShape* a = scene.find(pair.a);
  const PlacedShape* b = scene.find(pair.b);
  if (a == nullptr || b == nullptr || !is_sphere(*a) || !is_sphere(*b)) return std::nullopt;
  if (a->vertices[0].isApprox(b->vertices[0], 1e-6)) return std::nullopt;
  return Ends{a->vertices[0], b->vertices[0]};
}

void draw_contacts(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const bool by_age = pair.incremental && scene.shows(Layer::Persistent);
  const std::string factor = spell_factor(scene.depth_factor);
  for (const auto& [manifold, point] : by_age ? std::vector<PairPoint>() : kept_points(pair)) {
    const MarkKind kind = mark_of(scene, *point);
    // From the surface of A to that of B. Of a point that does not touch yet, the gap, thinner.
    const auto [from, to] = whisker_at(scene, pair, *manifold, *point);
    const float width = kind == MarkKind::Apart ? 1.5f : 2.5f;
    sketch.bordered_line(from, to, {width, kContact}, 2 * width);
    sketch.mark(kind, point->position, kContact);
    if (kind == MarkKind::Apart)
      sketch.explain(kApartSwatch, "point within the margin, not touching: line = gap" + factor);
    else if (kind == MarkKind::Square)
      sketch.explain(kOneShotSwatch, "one-shot point, whisker = overlap" + factor);
    else
      sketch.explain(kContactSwatch, "contact point, whisker = overlap" + factor);
  }
  const bool measured_elsewhere =
      scene.shows(Layer::SatAxes) || scene.shows(Layer::ContactAxis) || scene.shows(Layer::Simplex);
  if (measured_elsewhere) return;
  if (const auto centers = line_of_centers(scene, pair)) {
    sketch.line(centers->a, centers->b, {1.2f, with_alpha(kShapeEdge, 0.8f), true});
    sketch.explain(kLineOfCentersSwatch, "line between the centres");
  }
  if (const auto gap = measured_gap(scene, pair))
    draw_gap(scene, gap->a, gap->b, pair.separation, 16, scene.camera.right(), sketch);
}

}  // namespace

const LayerDrawing kContactsLayer{
    .needs = {&trace::Stages::sat, &trace::Stages::gjk, &trace::Stages::reduction},
    .beneath =
        [](const Scene& scene, Sketch& sketch) {
          if (!scene.shows(Layer::ReferenceFace)) draw_touched_triangles(scene, sketch);
        },
    .result = draw_contacts,
};

}  // namespace contactscope::draw

#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/measure.h"
#include "draw/scene/pair_points.h"
#include "draw/scene/swatches.h"

/// Catto 2013, "Continuous Collision": a contact of shapes that are still apart lets them close by no
/// more than the gap. Where a body would be a frame later without it, and the gap.
namespace contactscope::draw {
namespace {

constexpr double kLeastWay = 8;  // pixels
constexpr double kAside = 44;    // pixels of the gap from the point, whose impulse runs along it

constexpr LineStyle kGhost{2.0f, kDropped, true};

constexpr Swatch kAheadSwatch{LegendGroup::Motion, 4,
                              [](const SwatchPen& pen) { pen.dashes(2, kDropped); }};

// The silhouette alone.
void draw_ghost(const Camera& camera, const PlacedShape& shape, Sketch& sketch) {
  const double radius = shape.mesh->shape->radius;
  if (radius > 0) {
    const std::vector<Vec3d> outline = RoundBody(shape.vertices, radius).outline(camera);
    if (!outline.empty()) sketch.curves.push_back({outline, kGhost, true});
    return;
  }
  const auto front = [&](int face) {
    return face >= 0 && camera.faces(shape.polygon(face).front(), shape.normal(face));
  };
  for (const ShapeMesh::Edge& edge : shape.mesh->edges) {
    if (front(edge.left) != front(edge.right))
      sketch.line(shape.vertex(edge.from), shape.vertex(edge.to), kGhost);
  }
}

/// The shape of a body that goes so far in a frame that it is seen; null: it does not.
const PlacedShape* fast_shape(const Scene& scene, const trace::Body& body) {
  const double pixels = scene.camera.pixels_per_metre(body.center_of_mass);
  if ((scene.scales.step * body.velocity).norm() * pixels < kLeastWay * scene.scales.pixel)
    return nullptr;
  return scene.find(body.name);
}

struct Gap {
  Vec3d from, to;
  double metres;
};

std::vector<Gap> gaps_of(const Scene& scene, const trace::Pair& pair) {
  std::vector<Gap> gaps;
  const PlacedShape* a = scene.find(pair.a);
  const bool on_a = a == nullptr || a->mesh->shape->radius == 0;
  for (const auto& [manifold, point] : all_points(pair)) {
    if (!stands_off(*point, scene.scales)) continue;
    const Vec3d other = point->position + (on_a ? 1 : -1) * point->separation * manifold->normal;
    gaps.push_back({point->position, other, point->separation});
  }
  return gaps;
}

Vec3d aside_of(const Scene& scene, const Gap& gap) {
  const double pixel = scene.scales.pixel / scene.camera.pixels_per_metre(gap.from);
  return kAside * pixel * scene.camera.up();
}

bool has_next_frame(const Scene& scene) {
  return scene.frame.solver && scene.scales.step > 0;
}

void draw_ahead(const Scene& scene, Sketch& sketch) {
  if (!has_next_frame(scene)) return;
  for (const trace::Body& body : scene.bodies()) {
    const PlacedShape* shape = fast_shape(scene, body);
    if (shape == nullptr) continue;
    const Vec3d way = scene.scales.step * body.velocity;
    PlacedShape ghost = *shape;
    const double angle = scene.scales.step * body.angular_velocity.norm();
    if (angle > 0) {
      const Quatd turn(Eigen::AngleAxisd(angle, body.angular_velocity.normalized()));
      ghost.pose.rotation = (turn * ghost.pose.rotation).normalized();
      for (Vec3d& v : ghost.vertices) {
        const Vec3d arm = v - body.center_of_mass;
        v = body.center_of_mass + turn * arm;
      }
    }
    for (Vec3d& v : ghost.vertices) v += way;
    draw_ghost(scene.camera, ghost, sketch);
    sketch.line(body.center_of_mass, body.center_of_mass + way, {1.2f, kDropped, true});
  }
  for (const trace::Pair& pair : scene.frame.pairs) {
    for (const Gap& gap : gaps_of(scene, pair)) {
      const Vec3d aside = aside_of(scene, gap);
      for (const Vec3d& end : {gap.from, gap.to})
        sketch.line(end, end + 1.2 * aside, {1.0f, kAxis});
      draw_gap(scene, gap.from + aside, gap.to + aside, gap.metres, 12, scene.camera.up(), sketch);
    }
  }
}

void explain_ahead(const Scene& scene, Legend& legend) {
  if (!has_next_frame(scene)) return;
  if (std::ranges::any_of(scene.bodies(), [&](const trace::Body& body) {
        return fast_shape(scene, body) != nullptr;
      }))
    legend.explain(kAheadSwatch, "a frame later, if nothing stopped it");
  for (const trace::Pair& pair : scene.frame.pairs) {
    for (const Gap& gap : gaps_of(scene, pair)) {
      const Vec3d aside = aside_of(scene, gap);
      explain_gap(scene, gap.from + aside, gap.to + aside, legend);
    }
  }
}

}  // namespace

const LayerDrawing kAheadLayer{.above = draw_ahead, .explain_frame = explain_ahead};

}  // namespace contactscope::draw

#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/arrows.h"
#include "draw/scene/pair_points.h"
#include "draw/scene/swatches.h"

/// Catto 2013, "Continuous Collision": a contact of shapes that are still apart lets them close by no
/// more than the gap. Where a body would be a frame later without it, and the gap.
namespace contactscope::draw {
namespace {

constexpr double kLeastWay = 8;  // pixels
constexpr double kAside = 44;    // pixels of the gap from the point, whose impulse runs along it

constexpr LineStyle kGhost{2.0f, kDropped, true};

constexpr Swatch kAheadSwatch{LegendGroup::Motion, 4, [](auto& pen) { pen.dashes(2, kDropped); }};

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

/// The gap of a point that does not touch yet.
void draw_gap_at(const Scene& scene, bool on_a, const PairPoint& at, Sketch& sketch) {
  const auto& [manifold, point] = at;
  const Vec3d& from = point->position;
  const Vec3d to = from + (on_a ? 1 : -1) * point->separation * manifold->normal;
  const double pixel = scene.scales.pixel / scene.camera.pixels_per_metre(from);
  const Vec3d aside = kAside * pixel * scene.camera.up();
  for (const Vec3d& end : {from, to}) sketch.line(end, end + 1.2 * aside, {1.0f, kAxis});
  draw_gap(scene, from + aside, to + aside, point->separation, 12, scene.camera.up(), sketch);
}

void draw_ahead(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.solver || scene.scales.step <= 0) return;
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
    sketch.explain(kAheadSwatch, "a frame later, if nothing stopped it");
  }
  for (const trace::Pair& pair : scene.frame.pairs) {
    const PlacedShape* a = scene.find(pair.a);
    const bool on_a = a == nullptr || a->mesh->shape->radius == 0;
    for (const PairPoint& any : all_points(pair)) {
      if (stands_off(*any.point, scene.scales)) draw_gap_at(scene, on_a, any, sketch);
    }
  }
}

}  // namespace

const LayerDrawing kAheadLayer{.above = draw_ahead};

}  // namespace contactscope::draw

#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"
#include "draw/scene/round_body.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

constexpr double kLeastWay = 8;  // pixels
constexpr double kAside = 44;    // pixels of the gap from the point, whose impulse runs along it

constexpr LineStyle kGhost{2.0f, kDropped, true, LineStyle::Hidden::Same};

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
    if (front(edge.left) == front(edge.right)) continue;
    sketch.lines.push_back({shape.vertices[static_cast<std::size_t>(edge.from)],
                            shape.vertices[static_cast<std::size_t>(edge.to)], kGhost});
  }
}

}  // namespace

// Catto 2013, "Continuous Collision": a contact of shapes that are still apart lets them close by no
// more than the gap. Where a body would be a frame later without it, and the gap.
void draw_ahead(const Scene& scene, Sketch& sketch) {
  if (!scene.frame.solver || !(scene.scales.step > 0)) return;
  for (const trace::Body& body : scene.frame.solver->bodies) {
    const PlacedShape* shape = scene.find(body.name);
    const Vec3d way = scene.scales.step * body.velocity;
    const double pixels = scene.camera.pixels_per_metre(body.center_of_mass);
    if (shape == nullptr || way.norm() * pixels < kLeastWay * scene.scales.pixel) continue;
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
    sketch.lines.push_back({body.center_of_mass,
                            body.center_of_mass + way,
                            {1.2f, kDropped, true, LineStyle::Hidden::Same},
                            false});
    sketch.explain(LegendKind::Ahead, "a frame later, if nothing stopped it");
  }
  for (const trace::Pair& pair : scene.frame.pairs) {
    for (const trace::Manifold& manifold : pair.manifolds) {
      for (const trace::Point& point : manifold.points) {
        if (!(point.separation > scene.scales.touching)) continue;
        const PlacedShape* a = scene.find(pair.a);
        const bool on_a = a == nullptr || a->mesh->shape->radius == 0;
        const Vec3d other = point.position + (on_a ? 1 : -1) * point.separation * manifold.normal;
        const double pixel = scene.scales.pixel / scene.camera.pixels_per_metre(point.position);
        const Vec3d aside = kAside * pixel * scene.camera.up();
        for (const Vec3d& end : {point.position, other}) {
          sketch.lines.push_back({end, end + 1.2 * aside, {1.0f, kAxis}, false});
        }
        draw_labelled_gap(scene, point.position + aside, other + aside, point.separation, 12,
                          scene.camera.up(), sketch);
      }
    }
  }
}

}  // namespace contactscope::draw

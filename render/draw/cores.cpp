#include <algorithm>

#include "core/plane.h"
#include "draw/palette.h"
#include "draw/quantity.h"
#include "draw/scene.h"

namespace contactscope::draw {
namespace {

constexpr LineStyle kCoreOutline{1.8f, with_alpha(kReferenceFace, 0.9f), true,
                                 LineStyle::Hidden::Same};

// Half-space clipping of a convex polygon (Sutherland and Hodgman 1974).
std::vector<Vec3d> clipped_by(const std::vector<Vec3d>& polygon, const Plane<double>& plane) {
  std::vector<Vec3d> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d& from = polygon[i];
    const Vec3d& to = polygon[(i + 1) % polygon.size()];
    const double d0 = plane.distance(from), d1 = plane.distance(to);
    if (d0 <= 0) inside.push_back(from);
    if ((d0 < 0 && d1 > 0) || (d0 > 0 && d1 < 0)) {
      inside.push_back(from + d0 / (d0 - d1) * (to - from));
    }
  }
  return inside;
}

// The core's face is the face moved inwards, within all other planes moved inwards: what is left of
// the hull when a margin is taken off its faces.
void draw_hull_core(const PlacedShape& shape, double margin, Sketch& sketch) {
  const trace::Shape& solid = *shape.mesh->shape;
  std::vector<Plane<double>> planes;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Vec3d normal = shape.normal(static_cast<int>(f));
    planes.push_back({normal, normal.dot(shape.polygon(static_cast<int>(f))[0]) - margin});
  }
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    std::vector<Vec3d> face = shape.polygon(static_cast<int>(f));
    for (Vec3d& corner : face) corner -= margin * planes[f].normal;
    for (std::size_t other = 0; other < planes.size() && !face.empty(); ++other) {
      if (other != f) face = clipped_by(face, planes[other]);
    }
    if (face.size() > 2) sketch.outline(face, kCoreOutline);
  }
}

}  // namespace

// Gregorius 2015, "Building Incremental Manifolds": the cores stay apart while the margins overlap,
// so that closest points are enough. Round shapes show their cores already.
void draw_cores(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.incremental) return;
  double widest = 0;
  for (const bool of_a : {true, false}) {
    const double margin = of_a ? pair.incremental->margin_a : pair.incremental->margin_b;
    const PlacedShape* shape = scene.find(of_a ? pair.a : pair.b);
    if (shape == nullptr || margin <= 0 || shape->mesh->shape->radius > 0) continue;
    if (shape->mesh->shape->faces.empty() || shape->mesh->shape->type == "mesh") continue;
    draw_hull_core(*shape, margin, sketch);
    widest = std::max(widest, margin);
  }
  if (widest > 0) {
    sketch.explain(LegendKind::Core, "core, " + spell_length(widest) + " within the surface");
  }
}

}  // namespace contactscope::draw

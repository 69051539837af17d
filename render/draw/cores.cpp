#include <algorithm>

#include "core/plane.h"
#include "draw/palette.h"
#include "draw/quantity.h"
#include "draw/scene.h"

namespace contactscope::draw {
namespace {

constexpr LineStyle kCoreFront{1.5f, with_alpha(kReferenceFace, 0.75f), true,
                               LineStyle::Hidden::Same};
constexpr LineStyle kCoreBack{1.0f, with_alpha(kReferenceFace, 0.35f), true,
                              LineStyle::Hidden::Same};

struct CoreCorner {
  Vec3d at;
  std::size_t side;  // the face beyond the edge that begins here
};
using CoreFace = std::vector<CoreCorner>;

// Half-space clipping of a convex polygon (Sutherland and Hodgman 1974).
CoreFace clipped_by(const CoreFace& polygon, const Plane<double>& plane, std::size_t side) {
  CoreFace inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const CoreCorner& from = polygon[i];
    const Vec3d& to = polygon[(i + 1) % polygon.size()].at;
    const double d0 = plane.distance(from.at), d1 = plane.distance(to);
    if (d0 <= 0) inside.push_back({from.at, d1 > 0 && d0 == 0 ? side : from.side});
    if ((d0 < 0 && d1 > 0) || (d0 > 0 && d1 <= 0)) {
      inside.push_back({from.at + d0 / (d0 - d1) * (to - from.at), d0 < 0 ? side : from.side});
    }
  }
  return inside;
}

// The core's face is the face moved inwards, within all other planes moved inwards: what is left of
// the hull when a margin is taken off its faces. Edges between two faces are drawn once.
void draw_hull_core(const Camera& camera, const PlacedShape& shape, double margin, Sketch& sketch) {
  const trace::Shape& solid = *shape.mesh->shape;
  std::vector<Plane<double>> planes;
  std::vector<bool> front;
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const Vec3d normal = shape.normal(static_cast<int>(f));
    const Vec3d corner = shape.polygon(static_cast<int>(f))[0];
    planes.push_back({normal, normal.dot(corner) - margin});
    front.push_back(camera.faces(corner, normal));
  }
  for (std::size_t f = 0; f < planes.size(); ++f) {
    CoreFace face;
    for (const Vec3d& corner : shape.polygon(static_cast<int>(f))) {
      face.push_back({corner - margin * planes[f].normal, f});
    }
    for (std::size_t other = 0; other < planes.size() && !face.empty(); ++other) {
      if (other != f) face = clipped_by(face, planes[other], other);
    }
    for (std::size_t i = 0; face.size() > 2 && i < face.size(); ++i) {
      if (face[i].side < f) continue;  // drawn with the other face
      const bool seen = front[f] || front[face[i].side];
      sketch.lines.push_back(
          {face[i].at, face[(i + 1) % face.size()].at, seen ? kCoreFront : kCoreBack});
    }
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
    draw_hull_core(scene.camera, *shape, margin, sketch);
    widest = std::max(widest, margin);
  }
  if (widest > 0) {
    sketch.explain(LegendKind::Core, "core, " + spell_length(widest) + " within the surface");
  }
}

}  // namespace contactscope::draw

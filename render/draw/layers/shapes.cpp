#include <algorithm>
#include <optional>

#include "draw/scene/mesh_surface.h"
#include "draw/scene/palette.h"
#include "draw/scene/plane_patch.h"
#include "draw/scene/scene.h"
#include "draw/scene/shading.h"

namespace contactscope::draw {
namespace {

constexpr std::size_t kMostNames = 5;  // of one role in the legend

constexpr LineStyle kSilhouette{2.0f, kShapeEdge, false, LineStyle::Hidden::Faint};
constexpr LineStyle kFeature{1.5f, with_alpha(kShapeEdge, 0.85f), false, LineStyle::Hidden::Faint};
constexpr LineStyle kSmooth{1.0f, with_alpha(kShapeEdge, 0.16f), false, LineStyle::Hidden::Faint};

// A smooth outline, and inside the core that all is measured from: Gregorius 2015 draws spheres and
// capsules as points and segments with a radius.
void draw_round(const Scene& scene, const PlacedShape& shape, Sketch& sketch) {
  constexpr Color kCore = with_alpha(kShapeEdge, 0.6f);
  const RoundBody body(shape.vertices, shape.mesh->shape->radius);
  const int index = static_cast<int>(sketch.bodies.size());
  for (RoundBody::Facet& facet : body.front(scene.camera, key_light(scene.camera))) {
    sketch.surfaces.push_back(
        {std::move(facet.polygon), toned(shape.is_a ? kShapeA : kShapeB, facet.lit), index});
  }
  const std::vector<Vec3d> outline = body.outline(scene.camera);
  if (!outline.empty()) {
    sketch.shadows.push_back(body.shadow(scene.camera));
    sketch.curves.push_back({outline, kSilhouette, true});
  }
  sketch.bodies.push_back(body);
  if (body.core().size() == 2) {
    sketch.lines.push_back({body.core()[0], body.core()[1], {1.0f, kCore, true}});
  }
  for (const Vec3d& point : body.core()) sketch.marks.push_back({MarkKind::Core, point, kCore});
}

}  // namespace

void draw_solid(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch) {
  const trace::Shape& solid = *shape.mesh->shape;
  const Vec3d light = key_light(camera);
  std::vector<bool> front(solid.faces.size());
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    const std::vector<Vec3d> polygon = shape.polygon(static_cast<int>(f));
    const Vec3d normal = shape.normal(static_cast<int>(f));
    front[f] = camera.faces(polygon.front(), normal);
    if (!front[f]) continue;
    sketch.occluders.push_back(polygon);
    sketch.surfaces.push_back({polygon, toned(fill, normal.dot(light))});
  }
  for (const ShapeMesh::Edge& edge : shape.mesh->edges) {
    const bool left = front[static_cast<std::size_t>(edge.left)];
    const bool right = edge.right >= 0 && front[static_cast<std::size_t>(edge.right)];
    const bool silhouette = left != right;
    if (edge.smooth && !silhouette && !left) continue;  // hidden facets would only be noise
    sketch.lines.push_back({shape.vertices[static_cast<std::size_t>(edge.from)],
                            shape.vertices[static_cast<std::size_t>(edge.to)],
                            silhouette    ? kSilhouette
                            : edge.smooth ? kSmooth
                                          : kFeature});
  }
}

namespace {

// By name; a whole stack as one entry.
void explain_shapes(const Scene& scene, bool of_a, Sketch& sketch) {
  std::vector<std::string> names;
  for (const PlacedShape& shape : scene.shapes) {
    if (shape.is_a != of_a || !in_view(scene.camera, shape)) continue;
    names.push_back(shape.mesh->shape->name);
  }
  const LegendKind kind = of_a ? LegendKind::ShapeA : LegendKind::ShapeB;
  const std::string role = of_a ? "A: " : "B: ";
  if (names.size() > kMostNames) {
    sketch.explain(kind, role + names.front() + " to " + names.back());
    return;
  }
  for (const std::string& name : names) sketch.explain(kind, role + name);
}

}  // namespace

bool in_view(const Camera& camera, const PlacedShape& shape) {
  if (shape.mesh->shape->half_space || shape.mesh->shape->type == "mesh") return true;
  for (const Vec3d& point : extent_points(shape)) {
    const std::optional<Point2> at = camera.project(point);
    if (at && camera.viewport().contains(*at)) return true;
  }
  for (std::size_t f = 0; f < shape.mesh->normals.size(); ++f) {
    if (!project_polygon(camera, shape.polygon(static_cast<int>(f))).empty()) return true;
  }
  return false;
}

void draw_shapes(const Scene& scene, Sketch& sketch) {
  for (const PlacedShape& shape : scene.shapes) {
    const trace::Shape& solid = *shape.mesh->shape;
    if (solid.half_space) {
      draw_plane(scene, shape, sketch);
    } else if (solid.type == "mesh") {
      draw_mesh(scene, shape, sketch);
    } else if (solid.radius > 0) {
      draw_round(scene, shape, sketch);
    } else {
      draw_solid(scene.camera, shape, shape.is_a ? kShapeA : kShapeB, sketch);
    }
  }
  explain_shapes(scene, true, sketch);
  explain_shapes(scene, false, sketch);
}

}  // namespace contactscope::draw

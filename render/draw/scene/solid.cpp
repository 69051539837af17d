#include "draw/scene/solid.h"

#include <algorithm>

namespace contactscope::draw {
namespace {

constexpr LineStyle kSilhouette{2.0f, kShapeEdge, false, LineStyle::Hidden::Faint};
constexpr LineStyle kFeature{1.5f, with_alpha(kShapeEdge, 0.85f), false, LineStyle::Hidden::Faint};
constexpr LineStyle kSmooth{1.0f, with_alpha(kShapeEdge, 0.16f), false, LineStyle::Hidden::Faint};

}  // namespace

std::vector<bool> draw_faces(const Camera& camera, const PlacedShape& shape, const Color& fill,
                             bool both_sides, Sketch& sketch) {
  const Vec3d light = key_light(camera);
  std::vector<bool> front;
  for (int f = 0; f < count_of(shape.traced().faces); ++f) {
    const std::vector<Vec3d> polygon = shape.polygon(f);
    const Vec3d normal = shape.normal(f);
    front.push_back(camera.faces(polygon.front(), normal));
    if (!front.back() && !both_sides) continue;
    sketch.occluders.push_back(polygon);
    sketch.surfaces.push_back({polygon, toned(fill, (front.back() ? 1 : -1) * normal.dot(light))});
  }
  return front;
}

void draw_solid(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch) {
  const std::vector<bool> front = draw_faces(camera, shape, fill, false, sketch);
  for (const ShapeMesh::Edge& edge : shape.mesh->edges) {
    const bool left = at(front, edge.left);
    const bool silhouette = left != (edge.right >= 0 && at(front, edge.right));
    if (edge.smooth && !silhouette && !left) continue;  // hidden facets would only be noise
    sketch.line(shape.vertex(edge.from), shape.vertex(edge.to),
                silhouette    ? kSilhouette
                : edge.smooth ? kSmooth
                              : kFeature);
  }
}

void draw_round(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch) {
  constexpr Color kCore = with_alpha(kShapeEdge, 0.6f);
  const RoundBody body{shape.vertices, shape.traced().radius};
  const int index = count_of(sketch.bodies);
  for (RoundBody::Facet& facet : body.front(camera, key_light(camera)))
    sketch.surfaces.push_back({std::move(facet.polygon), toned(fill, facet.lit), index});
  const std::vector<Vec3d> outline = body.outline(camera);
  if (!outline.empty()) {
    sketch.shadows.push_back(body.shadow(camera));
    sketch.curves.push_back({outline, kSilhouette, true});
  }
  sketch.bodies.push_back(body);
  if (body.core.size() == 2) sketch.line(body.core[0], body.core[1], {1.0f, kCore, true});
  for (const Vec3d& point : body.core) sketch.mark(MarkKind::Core, point, kCore);
}

bool in_view(const Camera& camera, const PlacedShape& shape) {
  if (shape.traced().half_space || shape.is_mesh()) return true;
  const auto is_seen = [&](const Vec3d& point) { return camera.sees(point); };
  // Corners first: of what is in the middle of a picture the first one is seen.
  if (std::ranges::any_of(shape.vertices, is_seen)) return true;
  if (std::ranges::any_of(extent_points(shape), is_seen)) return true;
  for (int f = 0; f < count_of(shape.mesh->normals); ++f) {
    if (!project_polygon(camera, shape.polygon(f)).empty()) return true;
  }
  return false;
}

}  // namespace contactscope::draw

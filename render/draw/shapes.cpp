#include <algorithm>

#include "draw/palette.h"
#include "draw/scene.h"

namespace contactscope::draw {
namespace {

// Light enough for the contact inside to be seen, dense enough for a shape to read as solid.
constexpr float kShapeAlpha = 0.52f;
// Three tones: what looks at the light, what is turned from it, what lies between.
constexpr float kTones[3] = {0.84f, 0.93f, 1.0f};

Color toned(const Color& base, const Vec3d& normal, const Camera& camera) {
  const Vec3d light =
      (camera.up() * 1.0 - camera.right() * 0.55 + camera.right().cross(camera.up()) * 0.65)
          .normalized();
  const double lit = normal.dot(light);
  const float tone = kTones[lit > 0.6 ? 2 : lit > 0.1 ? 1 : 0];
  return {base.r * tone, base.g * tone, base.b * tone, kShapeAlpha};
}

}  // namespace

void draw_shapes(const Scene& scene, Sketch& sketch) {
  constexpr LineStyle kSilhouette{2.0f, kShapeEdge, false, LineStyle::Hidden::Faint};
  constexpr LineStyle kFeature{1.5f, with_alpha(kShapeEdge, 0.85f), false,
                               LineStyle::Hidden::Faint};
  constexpr LineStyle kSmooth{1.0f, with_alpha(kShapeEdge, 0.16f), false, LineStyle::Hidden::Faint};

  for (const PlacedShape& shape : scene.shapes) {
    const trace::Shape& solid = *shape.mesh->shape;
    std::vector<bool> front(solid.faces.size());
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      const std::vector<Vec3d> polygon = shape.polygon(static_cast<int>(f));
      const Vec3d normal = shape.normal(static_cast<int>(f));
      front[f] = scene.camera.faces(polygon.front(), normal);
      if (!front[f]) continue;
      sketch.occluders.push_back(polygon);
      sketch.surfaces.push_back(
          {polygon, toned(shape.is_a ? kShapeA : kShapeB, normal, scene.camera)});
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
    sketch.explain(shape.is_a ? LegendKind::ShapeA : LegendKind::ShapeB,
                   (shape.is_a ? "A: " : "B: ") + solid.name);
  }
}

void draw_pair_label(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const Vec3d up = scene.header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
  const PlacedShape* highest = nullptr;
  for (const std::string& name : {pair.a, pair.b}) {
    const PlacedShape* shape = scene.find(name);
    if (shape == nullptr) continue;
    if (highest == nullptr || up.dot(shape->pose.position - highest->pose.position) > 0) {
      highest = shape;
    }
  }
  if (highest == nullptr) return;
  const Vec3d middle = highest->pose.transform(highest->mesh->shape->center_of_mass);
  double top = 0;
  for (const Vec3d& v : highest->vertices) top = std::max(top, up.dot(v - middle));
  sketch.labels.push_back({.at = middle + top * up,
                           .text = pair.label,
                           .color = kText,
                           .size = 20,
                           .bold = true,
                           .clearance = 18,
                           .direction = up});
}

}  // namespace contactscope::draw

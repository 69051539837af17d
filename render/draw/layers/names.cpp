#include <limits>

#include "draw/layers/layer.h"
#include "draw/scene/home_region.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// Names at the middle of each shape, because the legend has no room for them in a heap.
namespace contactscope::draw {
namespace {

constexpr double kSmallName = 13;  // pixels, with many shapes

// Shapes larger than the picture, such as the ground, are named at their nearest corner.
Vec3d nearest_corner(const Camera& camera, const std::vector<Vec3d>& corners) {
  Vec3d nearest = corners.front();
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3d& corner : corners) {
    const double distance = (corner - camera.eye()).norm();
    if (distance >= least || !camera.sees(corner)) continue;
    least = distance;
    nearest = corner;
  }
  return nearest;
}

Vec3d place_of(const Camera& camera, const PlacedShape& shape) {
  if (shape.mesh->patch)
    return nearest_corner(camera, patch_corners(*shape.mesh->patch, shape.pose));
  if (shape.is_mesh()) return nearest_corner(camera, shape.vertices);
  return box_around(shape.vertices).center();
}

// Among many shapes only those in contact are named, which titles and panels mention. In a heap only
// the pair that stands out has names; see draw_crowd().
void draw_names(const Scene& scene, Sketch& sketch) {
  constexpr std::size_t kMaxNames = 12;
  if (scene.scales.heap) return;
  const std::vector<bool> touches = shapes_in_contact(scene.meshes, scene.frame);
  for (const PlacedShape& shape : scene.shapes)
    if (in_view(scene.camera, shape) && (scene.shapes.size() <= kMaxNames || touches[shape.place]))
      sketch.label(place_of(scene.camera, shape), shape.traced().name, kText,
                   scene.shapes.size() > 8 ? kSmallName : 16, 0);
}

}  // namespace

const LayerDrawing kNamesLayer{.above = draw_names};

}  // namespace contactscope::draw

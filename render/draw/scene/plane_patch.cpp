#include "draw/scene/plane_patch.h"

#include <algorithm>
#include <cmath>

#include "draw/scene/palette.h"
#include "draw/scene/shading.h"

namespace contactscope::draw {
namespace {

constexpr double kMargin = 0.16;     // around the shapes, of their larger extent in the plane
constexpr double kTickSpacing = 15;  // pixels at 720 lines
constexpr double kTickLength = 12;

PlanePatch rectangle(const trace::HalfSpace& plane, const Vec3d& level) {
  PlanePatch patch;
  patch.center = plane.offset * plane.normal;
  patch.u = level;
  patch.v = plane.normal.cross(level);
  patch.half_u = patch.half_v = 1;
  return patch;
}

}  // namespace

void fit_patches(const trace::Header& header, const std::vector<trace::Frame>& frames,
                 std::vector<ShapeMesh>& meshes) {
  const Vec3d up = header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    ShapeMesh& mesh = meshes[k];
    if (!mesh.shape->half_space) continue;
    const trace::HalfSpace& plane = *mesh.shape->half_space;
    Vec3d low = Vec3d::Zero(), high = Vec3d::Zero();
    bool found = false;
    std::optional<PlanePatch> patch;
    for (const trace::Frame& frame : frames) {
      const std::vector<PlacedShape> placed = place_shapes(meshes, frame);
      if (!patch) {
        // Level on the ground of the first frame; on level ground, along the x axis.
        const Vec3d normal = placed[k].pose.rotate(plane.normal);
        const Vec3d across = up.cross(normal);
        const Vec3d level = across.norm() > 1e-3
                                ? Vec3d(across.normalized())
                                : Vec3d((Vec3d::UnitX() - normal.x() * normal).normalized());
        patch = rectangle(plane, placed[k].pose.inverse_rotate(level));
      }
      for (const Vec3d& point : extent_points(placed)) {
        const Vec3d p = placed[k].pose.inverse_transform(point) - patch->center;
        const Vec3d at(p.dot(patch->u), p.dot(patch->v), 0);
        low = found ? Vec3d(low.cwiseMin(at)) : at;
        high = found ? Vec3d(high.cwiseMax(at)) : at;
        found = true;
      }
    }
    if (!patch) patch = rectangle(plane, any_perpendicular(plane.normal));
    if (found) {
      const double margin = kMargin * (high - low).maxCoeff();
      patch->center +=
          0.5 * (low.x() + high.x()) * patch->u + 0.5 * (low.y() + high.y()) * patch->v;
      patch->half_u = 0.5 * (high.x() - low.x()) + margin;
      patch->half_v = 0.5 * (high.y() - low.y()) + margin;
    }
    mesh.patch = patch;
  }
}

std::vector<Vec3d> patch_corners(const PlacedShape& plane) {
  const PlanePatch& patch = *plane.mesh->patch;
  std::vector<Vec3d> corners;
  for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    corners.push_back(plane.pose.transform(patch.center + u * patch.half_u * patch.u +
                                           v * patch.half_v * patch.v));
  }
  return corners;
}

void draw_plane(const Scene& scene, const PlacedShape& shape, Sketch& sketch) {
  if (!shape.mesh->patch) return;
  const PlanePatch& patch = *shape.mesh->patch;
  const Camera& camera = scene.camera;
  const Vec3d normal = shape.pose.rotate(shape.mesh->shape->half_space->normal);
  const std::vector<Vec3d> corners = patch_corners(shape);
  const Vec3d center = shape.pose.transform(patch.center);
  const bool outside = camera.faces(center, normal);
  if (outside) {
    sketch.occluders.push_back(corners);
    sketch.surfaces.push_back(
        {corners, toned(shape.is_a ? kShapeA : kShapeB, normal.dot(key_light(camera)))});
  }
  sketch.outline(corners, {1.5f, with_alpha(kShapeEdge, 0.85f), false, LineStyle::Hidden::Faint});
  if (!outside) return;
  constexpr LineStyle kTick{1.0f, with_alpha(kShapeEdge, 0.55f), false, LineStyle::Hidden::Faint};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d& from = corners[i];
    const Vec3d along = corners[(i + 1) % 4] - from;
    const Vec3d outwards = along.cross(normal);
    if (!camera.faces(from + 0.5 * along, outwards)) continue;
    const double length = along.norm();
    const double metres = 1 / camera.pixels_per_metre(from + 0.5 * along);
    const int count = std::clamp(static_cast<int>(length / (kTickSpacing * metres)), 4, 200);
    // Ticks lean to the side to which the border does not.
    const double rise = along.dot(camera.right()) * along.dot(camera.up());
    const Vec3d aside = rise > 0 ? camera.right() : Vec3d(-camera.right());
    const Vec3d tick = kTickLength * metres * (aside - normal);
    for (int k = 1; k <= count; ++k) {
      const Vec3d at = from + along * k / count;
      sketch.lines.push_back({at, at + tick, kTick});
    }
  }
}

}  // namespace contactscope::draw

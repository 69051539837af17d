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
  return {plane.offset * plane.normal, level, plane.normal.cross(level), 1, 1};
}

}  // namespace

void PatchFit::add(const Pose<double>& pose, const std::vector<Vec3d>& points) {
  if (!first_) {
    // Level on the ground of the first frame; on level ground, along the x axis.
    const Vec3d normal = pose.rotate(plane_.normal);
    const Vec3d across = up_.cross(normal);
    const Vec3d level = across.norm() > 1e-3
                            ? Vec3d(across.normalized())
                            : Vec3d((Vec3d::UnitX() - normal.x() * normal).normalized());
    first_ = rectangle(plane_, pose.inverse_rotate(level));
  }
  for (const Vec3d& point : points) {
    const Vec3d p = pose.inverse_transform(point) - first_->center;
    found_.extend(Eigen::Vector2d(p.dot(first_->u), p.dot(first_->v)));
  }
}

PlanePatch PatchFit::patch() const {
  PlanePatch patch = first_.value_or(rectangle(plane_, any_perpendicular(plane_.normal)));
  if (found_.isEmpty()) return patch;
  const double margin = kMargin * found_.sizes().maxCoeff();
  const Eigen::Vector2d middle = found_.center(), half = 0.5 * found_.sizes();
  patch.center += middle.x() * patch.u + middle.y() * patch.v;
  patch.half_u = half.x() + margin;
  patch.half_v = half.y() + margin;
  return patch;
}

std::vector<Vec3d> patch_corners(const PlanePatch& patch, const Pose<double>& pose) {
  std::vector<Vec3d> corners;
  for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    corners.push_back(
        pose.transform(patch.center + u * patch.half_u * patch.u + v * patch.half_v * patch.v));
  return corners;
}

void draw_plane(const Scene& scene, const PlacedShape& shape, Sketch& sketch) {
  if (!shape.mesh->patch) return;
  const PlanePatch& patch = *shape.mesh->patch;
  const Camera& camera = scene.camera;
  const Vec3d normal = shape.pose.rotate(shape.mesh->shape->half_space->normal);
  const std::vector<Vec3d> corners = patch_corners(patch, shape.pose);
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

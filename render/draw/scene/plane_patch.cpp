#include <algorithm>

#include "draw/scene/solid.h"

namespace contactscope::draw {
namespace {

constexpr double kMargin = 0.16;     // around the shapes, of their larger extent in the plane
constexpr double kTickSpacing = 15;  // pixels at 720 lines
constexpr double kTickLength = 12;

}  // namespace

PatchFit::PatchFit(const trace::HalfSpace& plane, const Pose<double>& pose, const Vec3d& up) {
  const Vec3d normal = pose.rotate(plane.normal);
  const Vec3d across = up.cross(normal);
  // On level ground along the x axis.
  const Vec3d level = across.norm() > 1e-3
                          ? Vec3d(across.normalized())
                          : Vec3d((Vec3d::UnitX() - normal.x() * normal).normalized());
  const Vec3d u = pose.inverse_rotate(level);
  square = {plane.offset * plane.normal, u, plane.normal.cross(u)};
}

void PatchFit::add(const Pose<double>& pose, const std::vector<Vec3d>& points) {
  poses.push_back(pose);
  for (const Vec3d& point : points) {
    const Vec3d p = pose.inverse_transform(point) - square.center;
    found.extend(Eigen::Vector2d(p.dot(square.u), p.dot(square.v)));
  }
}

PlanePatch PatchFit::patch() const {
  PlanePatch patch = square;
  if (found.isEmpty()) return patch;
  const double margin = kMargin * found.sizes().maxCoeff();
  const Eigen::Vector2d middle = found.center(), half = 0.5 * found.sizes();
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

void draw_plane(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch) {
  if (!shape.mesh->patch) return;
  const PlanePatch& patch = *shape.mesh->patch;
  const Vec3d normal = shape.pose.rotate(shape.traced().half_space->normal);
  const std::vector<Vec3d> corners = patch_corners(patch, shape.pose);
  const Vec3d center = shape.pose.transform(patch.center);
  const bool outside = camera.faces(center, normal);
  if (outside) {
    sketch.occluders.push_back(corners);
    sketch.surfaces.push_back({corners, toned(fill, normal.dot(key_light(camera)))});
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
      sketch.line(at, at + tick, kTick);
    }
  }
}

}  // namespace contactscope::draw

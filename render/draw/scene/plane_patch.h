#pragma once

#include <vector>

#include "draw/scene/scene.h"

/// What is drawn of a half-space: a rectangle of its plane, cut out around the shapes.
namespace contactscope::draw {

/// Fits the patch of one plane to a sequence, frame by frame: under the finite shapes of all frames
/// and a margin around them, with level edges. Without finite shapes a square of two metres.
class PatchFit {
 public:
  /// `up`: of the world.
  PatchFit(const trace::HalfSpace& plane, const Vec3d& up) : plane_(plane), up_(up) {}

  /// `points`: of the finite shapes in a frame in which the plane stands at `pose`.
  void add(const Pose<double>& pose, const std::vector<Vec3d>& points);
  PlanePatch patch() const;

 private:
  const trace::HalfSpace& plane_;
  Vec3d up_;
  std::optional<PlanePatch> first_;  // about the foot of the origin, with the edges of the result
  Eigen::AlignedBox2d found_;        // of the points, along u and v
};

/// World.
std::vector<Vec3d> patch_corners(const PlanePatch& patch, const Pose<double>& pose);

/// The rectangle, its border, and ticks that hang into the solid from the borders that face the
/// viewer: the sign for solid ground. Seen from inside of the solid, only the border.
void draw_plane(const Scene& scene, const PlacedShape& shape, Sketch& sketch);

}  // namespace contactscope::draw

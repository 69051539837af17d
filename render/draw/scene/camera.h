#pragma once

#include "core/convex_polygon.h"
#include "draw/scene/drawing.h"

namespace contactscope::draw {

inline Vec2d flat(const Point2& p) { return {p.x, p.y}; }
inline Point2 pixel(const Vec2d& p) { return pixel(p.x(), p.y()); }

/// Camera at `eye` that looks at `target`, both in metres. Maps world space to the pixels of
/// `viewport`. Perspective with a vertical field of view, or orthographic with a height in metres.
class Camera {
 public:
  /// `eye` and `target` must differ. If the view is along `up`, another axis serves as up.
  static Camera perspective(const Vec3d& eye, const Vec3d& target, const Vec3d& up,
                            double fov_radians, const Rect& viewport);
  static Camera orthographic(const Vec3d& eye, const Vec3d& target, const Vec3d& up, double height,
                             const Rect& viewport);

  const Vec3d& eye() const { return eye_; }
  bool is_perspective() const { return perspective_; }
  const Rect& viewport() const { return viewport_; }
  Vec3d right() const { return axes_.col(0); }
  Vec3d up() const { return axes_.col(1); }
  /// Unit vector from `point` to the eye.
  Vec3d to_eye(const Vec3d& point) const;
  /// Does a surface at `point` with this outward normal show its outside?
  bool faces(const Vec3d& point, const Vec3d& normal) const;

  /// World to camera space: x right, y up, z the distance in front of the eye.
  Vec3d to_camera(const Vec3d& point) const;
  /// Points nearer than this are not drawn, metres along the view direction.
  double near_distance() const { return near_; }
  /// Camera space to pixels; z >= near_distance().
  Point2 to_pixels(const Vec3d& camera_space) const;
  /// World to pixels; nothing for points behind the near plane.
  std::optional<Point2> project(const Vec3d& point) const;
  /// Whether a point is in front of the eye and inside the viewport.
  bool sees(const Vec3d& point) const;
  /// Pixels that one metre covers at right angles to the view at `point`.
  double pixels_per_metre(const Vec3d& point) const;

  bool operator==(const Camera&) const = default;

 private:
  Camera(const Vec3d& eye, const Vec3d& target, const Vec3d& up, const Rect& viewport,
         bool perspective, double scale);

  Vec3d eye_;
  Mat3<double> axes_;  // columns right, up, forward
  Rect viewport_;
  bool perspective_;
  double scale_;  // pixels per unit of tangent, or pixels per metre
  double near_ = 0;
};

/// Unit vector towards a directional light at the upper left of the camera.
Vec3d key_light(const Camera& camera);

/// The points in front of the near plane, in pixels.
std::vector<Vec2d> projected(const Camera& camera, std::span<const Vec3d> points);

/// Distance of two points on the screen, pixels; nothing if one is behind the near plane.
std::optional<float> seen_distance(const Camera& camera, const Vec3d& a, const Vec3d& b);

struct ViewFit {
  Vec3d target;
  double distance;  // of the eye from the target, metres
};

/// Nearest eye in a direction from which the points fill at most `share` of the view's width and
/// height. Centres the points unless the target is given. `half_height`: tangent of half the field
/// of view; `aspect`: width / height.
ViewFit fit_view(const std::vector<Vec3d>& points, const Vec3d& towards_eye, const Vec3d& world_up,
                 const std::optional<Vec3d>& target, double half_height, double aspect,
                 double share);

/// Part of a convex polygon in front of the near plane and inside the viewport, in pixels.
std::vector<Point2> project_polygon(const Camera& camera, const std::vector<Vec3d>& polygon);

/// The same for a segment.
std::optional<Segment2> project_segment(const Camera& camera, const Vec3d& from, const Vec3d& to);

std::vector<Point2> clip_polygon(const Rect& rect, std::vector<Point2> polygon);

std::optional<Segment2> clip_segment(const Rect& rect, const Point2& from, const Point2& to);

}  // namespace contactscope::draw

#pragma once

#include "draw/scene/camera.h"
#include "draw/scene/legend.h"

/// The contact plane along its normal, used in panels, in views of that kind and in explore.
namespace contactscope::draw {

/// Right and up on the page, unit.
struct PlaneAxes {
  Vec3d u = Vec3d::UnitX(), v = Vec3d::UnitY();

  Vec2d along(const Vec3d& point) const { return {u.dot(point), v.dot(point)}; }
};

/// The page's right is the camera's right, projected into the plane, so that map and 3D view look
/// alike. The page's up follows the screen's up, even if the view is along a wall.
PlaneAxes axes_as_seen(const Camera& camera, const Vec3d& normal);

/// From above if the plane is not vertical, with x to the right, as on a map.
PlaneAxes axes_from_above(const Vec3d& normal, const Vec3d& above);

/// Bounding rectangle of points in the plane, metres along its axes.
using PlaneExtent = Eigen::AlignedBox2d;

/// A contact plane on the page, and its drawing functions. `map` is its rectangle, `center` (metres
/// along the axes) the point in the middle of it.
struct ContactPlane : Pen {
  ContactPlane(const PlaneAxes& plane_axes, const Vec2d& middle, double scale, const Rect& place,
               const Pen& pen)
      : Pen(pen), axes(plane_axes), center(middle), pixels_per_metre(scale), map(place) {}

  Point2 at(const Vec3d& point) const;
  std::vector<Point2> at(const std::vector<Vec3d>& points) const;
  std::vector<Point2> at(const std::vector<trace::Point>& points) const;

  /// Clipped at the border of the map, because a floor is larger.
  void area(const std::vector<Point2>& polygon, const Color& color) const;
  void border(const std::vector<Point2>& polygon, double width, const Color& color,
              double dash = 0) const;
  /// The infinite line through two points.
  void line_through(const Vec3d& a, const Vec3d& b, double width, const Color& color,
                    double dash) const;

  /// Writes the order of choice next to each kept point, off all points and each other. A number
  /// without room is left out. `size`: of the marks.
  void number_kept(const std::vector<Point2>& places, const std::vector<int>& kept, double size,
                   const std::vector<int>& deepest = {}) const;

  /// Below the map on the right: a labelled length of 1, 2 or 5 times a power of ten.
  void scale_bar(double share, double y) const;

  PlaneAxes axes;
  Vec2d center;
  double pixels_per_metre;
  Rect map;
};

/// Mean of points on the page; unit direction from it to one of them (up at the mean itself).
Vec2d middle_of(const std::vector<Point2>& places);
Vec2d outward(const Vec2d& middle, const Vec2d& at);

/// Marks of the contact plane, in pixels. They are the same in all pictures, but smaller if points
/// are close together; `size` 1 is for a single patch.
void draw_kept_point(const Point2& at, const Pen& pen, double size);
/// `separated`: the point does not touch yet.
void draw_plain_point(const Point2& at, const Pen& pen, bool separated = false);
void draw_dropped_point(const Point2& at, const Pen& pen, double size);
/// A square around the point, kept or not.
void draw_deepest_mark(const Point2& at, const Pen& pen, double size);
/// Half the width of a kept point, at 720 lines.
inline constexpr double kKeptReach = 8.2;
inline constexpr double kDeepestReach = 12;

/// The first touching pair, whose contact plane is shown; nullptr without contacts.
const trace::Pair* pair_of_contact_plane(const trace::Frame& frame);

/// Whether the panel shows kept points. Not with several manifolds, which are reduced separately.
bool reduction_in_contact_plane(const trace::Pair& pair);

/// Stability of a touching pair, as the panel shows it. Null if it is not recorded.
const trace::Stability* stability_of(const trace::Pair& pair);

/// Adds the signs of panels to the picture's common legend.
void explain_panels(const View& view, const trace::Frame& frame, Legend& legend);

}  // namespace contactscope::draw

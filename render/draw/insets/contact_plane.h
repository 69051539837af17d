#pragma once

#include <optional>
#include <vector>

#include "core/convex_polygon.h"
#include "core/vec3.h"
#include "core/view.h"
#include "draw/scene/camera.h"
#include "draw/scene/legend.h"
#include "draw/scene/pen.h"
#include "trace/trace.h"

/// The contact plane seen along its normal: the same in panels, in views of that kind and in explore.
namespace contactscope::draw {

inline Vec2d flat(const Point2& p) {
  return {p.x, p.y};
}
inline Point2 pixel(const Vec2d& p) {
  return pixel(p.x(), p.y());
}

/// Right and up on the page, unit.
struct PlaneAxes {
  Vec3d u = Vec3d::UnitX(), v = Vec3d::UnitY();

  Vec2d along(const Vec3d& point) const { return {u.dot(point), v.dot(point)}; }
};

/// Right on the page is the camera's right as far as the plane has it, so that map and 3D view read
/// alike. Looked at along a wall, up on the screen is the better guide than depth.
PlaneAxes axes_as_seen(const Camera& camera, const Vec3d& normal);

/// From above where there is an above, with x to the right, as on a map.
PlaneAxes axes_from_above(const Vec3d& normal, const Vec3d& above);

/// The least rectangle of a plane around points, metres along its axes.
using PlaneExtent = Eigen::AlignedBox2d;

/// A contact plane on the page, and what draws on it. `map` is its place, `center` (metres along the
/// axes) the middle of it.
struct ContactPlane : Pen {
  ContactPlane(const PlaneAxes& plane_axes, const Vec2d& middle, double scale, const Rect& place,
               const Pen& pen)
      : Pen(pen), axes(plane_axes), center(middle), pixels_per_metre(scale), map(place) {}

  Point2 at(const Vec3d& point) const;
  std::vector<Point2> at(const std::vector<Vec3d>& points) const;
  std::vector<Point2> at(const std::vector<trace::Point>& points) const;

  /// Cut off at the border of the map: of a floor there is only a part.
  void area(const std::vector<Point2>& polygon, const Color& color) const;
  void border(const std::vector<Point2>& polygon, double width, const Color& color,
              double dash = 0) const;
  /// The endless line through two points.
  void line_through(const Vec3d& a, const Vec3d& b, double width, const Color& color,
                    double dash) const;

  /// The order in which points were kept, beside each, off all points and each other; one without
  /// room is left out. `size`: of the marks.
  void number_kept(const std::vector<Point2>& places, const std::vector<int>& kept, double size,
                   const std::vector<int>& deepest = {}) const;

  /// Under the map on its right: a length of 1, 2 or 5 times a power of ten, with its name.
  void scale_bar(double share, double y) const;

  PlaneAxes axes;
  Vec2d center;
  double pixels_per_metre;
  Rect map;
};

/// The middle of places on the page, and the way out of it to one of them: unit, up at the middle.
Vec2d middle_of(const std::vector<Point2>& places);
Vec2d way_out(const Vec2d& middle, const Vec2d& at);

/// The marks of the contact plane, in pixels: the same in every picture of it, but for their size
/// where points stand close; 1 is that of a single patch.
void draw_kept_point(const Point2& at, const Pen& pen, double size);
/// `apart`: it does not touch yet.
void draw_plain_point(const Point2& at, const Pen& pen, bool apart = false);
void draw_dropped_point(const Point2& at, const Pen& pen, double size);
/// A square about the point, whatever became of it.
void draw_deepest_mark(const Point2& at, const Pen& pen, double size);
/// Half the width of a kept point, at 720 lines.
inline constexpr double kKeptReach = 8.2;
inline constexpr double kDeepestReach = 12;

/// The pair whose contact plane is shown, the first that touches; nullptr where none does.
const trace::Pair* pair_of_contact_plane(const trace::Frame& frame);

/// Whether its panel shows which points were kept; of many manifolds each was reduced by itself.
bool reduction_in_contact_plane(const trace::Pair& pair);

/// What its panel shows: how a pair that touches stands. Null where that was not recorded.
const trace::Stability* stability_of(const trace::Pair& pair);

/// What the legend has to say about the panels: it is one for the whole picture.
void explain_panels(const View& view, const trace::Frame& frame, Legend& legend);

}  // namespace contactscope::draw

#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "core/convex_polygon.h"
#include "core/vec3.h"
#include "draw/scene/camera.h"
#include "draw/scene/pen.h"
#include "trace/trace.h"

/// The contact plane seen along its normal: the same in panels, in views of that kind and in explore.
namespace contactscope::draw {

struct Layout;

inline Vec2d flat(const Point2& p) {
  return {p.x, p.y};
}
inline Point2 pixel(const Vec2d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}

/// Right and up on the page, unit.
struct PlaneAxes {
  Vec3d u = Vec3d::UnitX(), v = Vec3d::UnitY();
};

/// Right on the page is the camera's right as far as the plane has it, so that map and 3D view read
/// alike. Looked at along a wall, up on the screen is the better guide than depth.
PlaneAxes axes_as_seen(const Camera& camera, const Vec3d& normal);

/// From above where there is an above, with x to the right, as on a map.
PlaneAxes axes_from_above(const Vec3d& normal, const Vec3d& above);

/// The least rectangle of a plane around points, metres.
struct PlaneExtent {
  std::array<double, 2> low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  std::array<double, 2> high{-std::numeric_limits<double>::max(),
                             -std::numeric_limits<double>::max()};

  void include(const PlaneAxes& axes, const Vec3d& point);
  bool empty() const { return low[0] > high[0]; }
  std::array<double, 2> center() const {
    return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
  }
  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
};

/// A contact plane on the page. `map` is its place, `center` (metres along the axes) the middle of
/// it.
class ContactPlane {
 public:
  ContactPlane(const PlaneAxes& axes, const std::array<double, 2>& center, double pixels_per_metre,
               const Rect& map, const Pen& pen)
      : axes_(axes), center_(center), pixels_per_metre_(pixels_per_metre), map_(map), pen_(pen) {}

  Point2 at(const Vec3d& point) const;
  std::vector<Point2> at(const std::vector<Vec3d>& points) const;
  double pixels_per_metre() const { return pixels_per_metre_; }

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
                   const std::optional<std::size_t>& deepest = std::nullopt) const;

  /// Under the map on its right: a length of 1, 2 or 5 times a power of ten, with its name.
  void scale_bar(double share, double y) const;

 private:
  PlaneAxes axes_;
  std::array<double, 2> center_;
  double pixels_per_metre_;
  Rect map_;
  Pen pen_;
};

/// The marks of the contact plane, in pixels: the same in every picture of it, but for their size
/// where points stand close; 1 is that of a single patch.
void draw_kept_point(const Point2& at, const Pen& pen, double size);
void draw_plain_point(const Point2& at, const Pen& pen);
/// A point that does not touch yet.
void draw_apart_point(const Point2& at, const Pen& pen);
void draw_dropped_point(const Point2& at, const Pen& pen, double size);
/// A square about the point, whatever became of it.
void draw_deepest_mark(const Point2& at, const Layout& layout, double size, const Color& color,
                       Drawing& drawing);
/// Half the width of a kept point, at 720 lines.
inline constexpr double kKeptReach = 8.2;

}  // namespace contactscope::draw

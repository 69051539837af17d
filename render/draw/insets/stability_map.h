#pragma once

#include <array>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// The contact plane of one pair, seen along the normal so that it reads like the camera's picture.
class StabilityMap {
 public:
  /// Middle of the map at `center` (metres), `pixels_per_metre` on the page. Right on the page is
  /// the camera's right as far as the plane has it.
  StabilityMap(const Vec3d& normal, const Camera& camera, const Rect& rect);

  /// Where a point lies in the plane, metres right and up.
  std::array<double, 2> flat(const Vec3d& point) const { return {u_.dot(point), v_.dot(point)}; }
  void show(const std::array<double, 2>& center, double pixels_per_metre);

  /// `plain`: points that have no age are dots, as elsewhere.
  void draw(const trace::Pair& pair, bool plain, float pixel, Drawing& drawing) const;

 private:
  Point2 at(const Vec3d& point) const;
  void draw_margin(const trace::Stability& stability, float pixel, Drawing& drawing) const;
  void draw_axis(const std::array<Vec3d, 2>& axis, float pixel, Drawing& drawing) const;

  Vec3d u_, v_;
  Rect rect_;
  std::array<double, 2> center_{};
  double scale_ = 1;
};

/// What must be in sight: points, support and projection.
std::vector<Vec3d> stability_extent(const trace::Pair& pair);

}  // namespace contactscope::draw

#pragma once

#include <span>

#include "core/manifold.h"

namespace contactscope {

/// How good a reduction is, whatever made it. Areas in square metres, of convex hulls in the
/// contact plane.
struct ReductionQuality {
  double area = 0;            // of the kept points
  double best_area = 0;       // the most that as many points can span
  double area_ratio = 1;      // area / best_area; 1 where no choice spans an area
  bool deepest_kept = false;  // a point of the least separation is among them
  /// How much of a moment is lost. A unit force along the normal resists, about an axis in the
  /// plane through the centroid of all points, at most the reach of the patch across that axis, in
  /// metres; this is the largest shortfall of that reach over all axes (the distance of the
  /// farthest point from the kept polygon), as a fraction of the patch's radius. 0 for one point.
  double wrench_error = 0;
  /// Metres: how far the plane that fits the kept depths best (least squares) is from the depth of
  /// any point.
  double depth_error = 0;
};

/// `kept` are indices into `points`, which share a plane with unit `normal`.
ReductionQuality measure_reduction(std::span<const ContactPoint<double>> points,
                                   const Vec3d& normal, std::span<const int> kept, int max_points);

/// Whether a place, seen along unit `normal`, lies in the convex hull of the kept points: an
/// upright load through it, say the weight at the centre of mass, makes nothing tip. Points within
/// rounding of the edge count as inside.
bool supports(std::span<const ContactPoint<double>> points, const Vec3d& normal,
              std::span<const int> kept, const Vec3d& place);

}  // namespace contactscope

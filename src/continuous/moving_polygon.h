#pragma once

#include "core/vec3.h"

namespace contactscope {

/// Minkowski difference of two features: a triangle for a vertex and a face, a parallelogram for
/// two edges. The features meet when it contains the origin. Its corners are differences of the
/// features' corners, so they move on straight lines as well:
///
///     d[2] ---- d[1]... a ring of kCorners, spanned by d[1] - d[0] and d[kCorners - 1] - d[0]:
///       |  \  |         its points are d[0] + u (d[1] - d[0]) + v (d[last] - d[0])
///     d[0]
template <int kCorners> struct MovingPolygon {
  static constexpr int kLast = kCorners - 1;
  using Ring = std::array<Vec3d, kCorners>;

  Ring start, end;  // metres

  Ring at_time(double time) const {
    Ring ring;
    for (int i = 0; i < kCorners; ++i)
      at(ring, i) = at(start, i) + time * (at(end, i) - at(start, i));
    return ring;
  }
  /// Largest absolute coordinate at any time, metres.
  double size() const {
    Vec3d most = Vec3d::Zero();
    for (int i = 0; i < kCorners; ++i)
      most = most.cwiseMax(at(start, i).cwiseAbs()).cwiseMax(at(end, i).cwiseAbs());
    return most.maxCoeff();
  }
  /// Whether a coordinate axis separates the features from 0 to 1: signs of differences are exact.
  bool is_separated_along_coordinates() const {
    Vec3d least = start[0], most = start[0];
    for (int i = 0; i < kCorners; ++i) {
      least = least.cwiseMin(at(start, i)).cwiseMin(at(end, i));
      most = most.cwiseMax(at(start, i)).cwiseMax(at(end, i));
    }
    return (least.array() > 0).any() || (most.array() < 0).any();
  }
};

/// The point of a plane polygon nearest to the origin. The polygon is a triangle or a
/// parallelogram, possibly degenerate to a segment or a point.
struct NearestOfPolygon {
  double distance = std::numeric_limits<double>::infinity();  // metres
  Vec3d point = Vec3d::Zero();
  double u = 0, v = 0;        // of the point, see MovingPolygon
  int first = 0, second = 0;  // corners of the point's edge, or the same one twice
  bool is_inside = false;     // then all corners support the point
};

/// Normal of the polygon, of length twice its area; zero if its height is within rounding.
template <std::size_t kCorners> Vec3d normal_of(const std::array<Vec3d, kCorners>& ring) {
  const Vec3d a = kCorners == 4 ? ring[2] - ring[0] : ring[1] - ring[0];
  const Vec3d b = kCorners == 4 ? ring[3] - ring[1] : ring[2] - ring[0];
  const Vec3d normal = a.cross(b);
  // Each corner has an error of some roundings.
  double farthest = 0;
  for (const Vec3d& corner : ring) farthest = std::max(farthest, corner.squaredNorm());
  const double noise = 0x1p-100 * farthest * std::max(a.squaredNorm(), b.squaredNorm());
  return normal.squaredNorm() > noise ? normal : Vec3d(Vec3d::Zero());
}

/// Point nearest to the origin on the line through two corners, or on the segment. Orthogonalised
/// against the direction twice, to remove the rounding of the first time.
inline Vec3d foot_on_edge(const Vec3d& from, const Vec3d& to, bool of_segment, double& fraction) {
  const Vec3d along = to - from;
  const double squared = along.squaredNorm();
  fraction = 0;
  if (!(squared > 0)) return from;
  fraction = -from.dot(along) / squared;
  if (of_segment && fraction <= 0) return fraction = 0, from;
  if (of_segment && fraction >= 1) return fraction = 1, to;
  const Vec3d foot = from + fraction * along;
  return foot - foot.dot(along) / squared * along;
}

template <std::size_t kCorners>
NearestOfPolygon nearest_of_polygon(const std::array<Vec3d, kCorners>& ring) {
  constexpr int kCount = static_cast<int>(kCorners);
  NearestOfPolygon nearest;
  // The corners in the coordinates u and v.
  constexpr std::array<double, 4> kU = {0, 1, kCount == 4 ? 1 : 0, 0}, kV = {0, 0, 1, 1};
  const Vec3d normal = normal_of(ring);
  const double squared = normal.squaredNorm();
  nearest.is_inside = squared > 0;
  std::array<double, kCorners> of_edge;  // areas of the origin's foot with each edge, signed
  double squared_distance = nearest.distance;
  for (int i = 0; i < kCount; ++i) {
    const int next = i + 1 == kCount ? 0 : i + 1;
    const Vec3d& from = at(ring, i);
    const Vec3d& to = at(ring, next);
    at(of_edge, i) = normal.dot(from.cross(to - from));
    nearest.is_inside = nearest.is_inside && at(of_edge, i) >= 0;
    double fraction;
    const Vec3d foot = foot_on_edge(from, to, true, fraction);
    const double found = foot.squaredNorm();
    if (found < squared_distance) {
      squared_distance = found;
      nearest.point = foot;
      nearest.first = fraction < 1 ? i : next;
      nearest.second = fraction > 0 ? next : i;
      nearest.u = at(kU, i) + fraction * (at(kU, next) - at(kU, i));
      nearest.v = at(kV, i) + fraction * (at(kV, next) - at(kV, i));
    }
  }
  if (nearest.is_inside) {
    // The plane's distance is most accurate when computed from the nearest corner.
    const Vec3d* corner = ring.data();
    for (const Vec3d& other : ring)
      if (other.squaredNorm() < corner->squaredNorm()) corner = &other;
    nearest.point = normal.dot(*corner) / squared * normal;
    squared_distance = nearest.point.squaredNorm();
    // Areas opposite corner 1 and the last corner, over the whole. The normal has twice the area
    // for a parallelogram's diagonals and for a triangle's sides.
    const double area = kCount == 4 ? 0.5 * squared : squared;
    nearest.u = std::clamp(at(of_edge, kCount - 1) / area, 0.0, 1.0);
    nearest.v = std::clamp(of_edge[0] / area, 0.0, 1.0);
  }
  nearest.distance = std::sqrt(squared_distance);
  return nearest;
}

/// A direction that turns with the polygon: direction + time * turn, with time 0 now. The corners
/// that carry the nearest point stay equally far along it, to first order.
struct TurningAxis {
  Vec3d direction;             // any length
  Vec3d turn = Vec3d::Zero();  // per step
};

/// From the direction of an edge and its change in the step.
inline TurningAxis axis_of_edge(const Vec3d& direction, const Vec3d& along, const Vec3d& change) {
  const double squared = along.squaredNorm();
  if (!(squared > 0)) return {direction};
  return {direction, Vec3d(-direction.dot(change) / squared * along)};
}

/// From the two directions that span the polygon, and their changes.
inline TurningAxis axis_of_plane(const Vec3d& direction, const Vec3d& side_u, const Vec3d& side_v,
                                 const Vec3d& change_u, const Vec3d& change_v) {
  const Vec3d normal = side_u.cross(side_v);
  const double squared = normal.squaredNorm();
  if (!(squared > 0)) return {direction};
  const double of_u = -direction.dot(change_u), of_v = -direction.dot(change_v);
  return {direction, Vec3d((of_u * side_v.cross(normal) + of_v * normal.cross(side_u)) / squared)};
}

}  // namespace contactscope

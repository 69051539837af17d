#pragma once

#include <array>
#include <vector>

#include "core/vec3.h"

namespace contactscope::test {

/// The distance to a triangle soup, with its sign, by exhaustion in extended precision: of each triangle
/// the nearest point by barycentric coordinates where it is inside, else of each of its sides. Inside
/// is where the solid angles of all triangles are nearer to a full sphere than to none (van Oosterom and
/// Strackee 1983, "The Solid Angle of a Plane Triangle").
class SurfaceOracle {
 public:
  using Real = long double;
  using Point = Eigen::Matrix<Real, 3, 1>;

  SurfaceOracle(const std::vector<Vec3d>& vertices,
                const std::vector<std::array<int, 3>>& triangles);

  Real distance(const Vec3d& point) const;         // not negative
  Real winding(const Vec3d& point) const;          // whole where the soup is closed
  Real signed_distance(const Vec3d& point) const;  // negative inside

 private:
  std::vector<std::array<Point, 3>> triangles_;
};

}  // namespace contactscope::test

#pragma once

#include <array>
#include <vector>

#include "core/vec3.h"

namespace contactscope::test {

/// Signed distance to a triangle soup by exhaustion in extended precision. The nearest point of
/// each triangle comes from barycentric coordinates if it is inside, else from each of its sides. A
/// point is inside if the solid angles of all triangles add up to more than half of a full sphere
/// (van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle").
class SurfaceOracle {
 public:
  using Real = long double;
  using Point = Eigen::Matrix<Real, 3, 1>;

  SurfaceOracle(const std::vector<Vec3d>& vertices,
                const std::vector<std::array<int, 3>>& triangles);

  Real distance(const Vec3d& point) const;         // not negative
  Real winding(const Vec3d& point) const;          // an integer if the soup is closed
  Real signed_distance(const Vec3d& point) const;  // negative inside

 private:
  std::vector<std::array<Point, 3>> triangles_;
};

}  // namespace contactscope::test

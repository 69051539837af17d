#pragma once

#include <span>
#include <vector>

#include "geometry/mesh.h"

namespace contactscope::test {

/// Signed distances of points in one cube from a surface, by exhaustion in double. Nearest points
/// of triangles come from barycentric coordinates (Ericson 2005, 5.1.5), which fields do not use.
/// All triangles are measured once, from the middle of the cube; those farther than the nearest one
/// plus the cube's diagonal are left out. Negative behind the nearest triangle; among equally near
/// ones, the one whose plane is farthest decides, as for a closed surface with its fronts outside.
class FieldJudge {
 public:
  explicit FieldJudge(const Mesh<double>& mesh);

  /// Selects the cube of the following queries.
  void look_at(const Vec3d& middle, double side);
  double distance(const Vec3d& point) const;

 private:
  struct Triangle {
    Vec3d corner, first, second, normal;  // a corner, the sides from it, unit normal
    Vec3d nearest(const Vec3d& point) const;
  };
  std::vector<Triangle> all_, near_;
};

}  // namespace contactscope::test

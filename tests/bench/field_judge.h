#pragma once

#include <span>
#include <vector>

#include "geometry/mesh.h"

namespace contactscope::test {

/// Says how far points of one cube are from a surface, with a sign, by exhaustion in double: nearest points
/// of triangles by barycentric coordinates (Ericson 2005, 5.1.5), which fields do not use. All triangles
/// are looked at once, from the middle of the cube; those that are farther than the nearest one and the
/// cube's diagonal are left out. Negative behind the triangle that is nearest; of equally near ones that
/// whose plane is farthest, as of a closed surface with its fronts outside.
class FieldJudge {
 public:
  explicit FieldJudge(const Mesh<double>& mesh);

  /// The cube that is asked about from now on.
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

#include "field/surface_of.h"

#include "core/at.h"
#include "geometry/triangulate.h"

namespace contactscope {

Mesh<double> surface_of(const Hull<double>& hull) {
  std::vector<std::array<int, 3>> triangles;
  for (int face = 0; face < hull.face_count(); ++face) {
    const std::vector<int> around = face_vertices(hull, face);
    const std::vector<Vec3d> corners =
        mapped(around, [&](int vertex) -> Vec3d { return at(hull.vertices, vertex); });
    for (const std::array<int, 3>& triangle : triangulate_polygon(corners))
      triangles.push_back(
          {at(around, triangle[0]), at(around, triangle[1]), at(around, triangle[2])});
  }
  return build_mesh(hull.vertices, std::move(triangles));
}

}  // namespace contactscope

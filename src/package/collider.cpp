#include <cmath>

#include "core/at.h"
#include "core/input_error.h"
#include "geometry/hull_builder.h"
#include "geometry/primitives.h"
#include "package/facts.h"

namespace contactscope::package {
namespace {

void require_length(double length, const char* what) {
  if (!(length > 0) || !std::isfinite(length))
    throw ShapeError(std::string(what) + " is " + std::to_string(length) +
                     "; give metres, more than 0");
}

void require_finite(const Vec3& place, const char* what) {
  if (!to_inside(place).allFinite())
    throw ShapeError(std::string(what) + " has a coordinate that is not finite; give metres");
}

std::vector<Vec3d> places(const std::vector<Vec3>& vertices) {
  return mapped(vertices, [](const Vec3& vertex) { return to_inside(vertex); });
}

void require_indices(const auto& polygons, std::size_t vertices, const char* what) {
  for (const auto& polygon : polygons)
    for (const int index : polygon)
      if (index < 0 || static_cast<std::size_t>(index) >= vertices)
        throw ShapeError(std::string(what) + " uses vertex " + std::to_string(index) + " of " +
                         std::to_string(vertices) + "; indices start at 0");
}

using Inside = contactscope::Shape<double>;

Inside inside(const Sphere& sphere) {
  require_length(sphere.radius, "the radius of a sphere");
  return contactscope::Sphere<double>{sphere.radius};
}

Inside inside(const Capsule& capsule) {
  require_length(capsule.radius, "the radius of a capsule");
  require_finite(capsule.from, "an end of a capsule");
  require_finite(capsule.to, "an end of a capsule");
  return contactscope::Capsule<double>{{to_inside(capsule.from), to_inside(capsule.to)},
                                       capsule.radius};
}

Inside inside(const Box& box) { return make_box(to_inside(box.half_extents)); }

Inside inside(const Hull& hull) {
  for (const Vec3& vertex : hull.vertices) require_finite(vertex, "a vertex of a hull");
  if (hull.faces.empty())
    return build_hull(places(hull.vertices), {.weld_duplicates = true, .for_float = true});
  require_indices(hull.faces, hull.vertices.size(), "a face of a hull");
  return hull_from_polygons(places(hull.vertices), hull.faces);
}

Inside inside(const Plane& plane) {
  const Vec3d normal = to_inside(plane.normal);
  const double length = normal.norm();
  require_length(length, "the length of a plane's normal");
  if (!std::isfinite(plane.offset))
    throw ShapeError("the offset of a plane is not finite; give metres along the normal");
  return HalfSpace<double>{{normal / length, plane.offset}};
}

Inside inside(const Mesh& mesh) {
  require_indices(mesh.triangles, mesh.vertices.size(), "a triangle of a mesh");
  return build_mesh(places(mesh.vertices), mesh.triangles);
}

constexpr const char* kTypes[] = {"sphere", "capsule", "box", "hull", "plane", "mesh"};

}  // namespace

Collider::Collider(const Shape& shape, int) {
  try {
    const Inside built = std::visit([](const auto& kind) { return inside(kind); }, shape);
    built_ = std::make_shared<const Built>(
        Built{built, shape_cast<float>(built), kTypes[shape.index()]});
  } catch (const contactscope::ShapeError& error) {
    throw ShapeError(error.what());
  }
}

}  // namespace contactscope::package

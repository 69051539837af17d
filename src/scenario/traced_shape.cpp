#include "core/at.h"
#include "scenario/run.h"

namespace contactscope {
namespace {

template <class S>
void describe(const Sphere<S>& sphere, trace::Shape& traced) {
  traced.vertices = {Vec3d::Zero()};
  traced.radius = sphere.radius;
}

template <class S>
void describe(const Capsule<S>& capsule, trace::Shape& traced) {
  traced.vertices = cast_each<Vec3d>(capsule.points);
  traced.edges = {{0, 1}};
  traced.radius = capsule.radius;
  traced.center_of_mass = 0.5 * (traced.vertices[0] + traced.vertices[1]);
}

template <class S>
void describe(const Hull<S>& hull, trace::Shape& traced) {
  traced.vertices = cast_each<Vec3d>(hull.vertices);
  for (int face = 0; face < hull.face_count(); ++face)
    traced.faces.push_back(face_vertices(hull, face));
  for (std::size_t edge = 0; edge < hull.half_edges.size(); edge += 2)
    traced.edges.push_back({hull.half_edges[edge].origin, hull.half_edges[edge + 1].origin});
  traced.center_of_mass = hull.centroid.template cast<double>();
}

template <class S>
void describe(const HalfSpace<S>& half_space, trace::Shape& traced) {
  const Plane<double> plane = half_space.plane.template cast<double>();
  traced.half_space = trace::HalfSpace{plane.normal, plane.offset};
}

template <class S>
void describe(const Mesh<S>& mesh, trace::Shape& traced) {
  traced.vertices = cast_each<Vec3d>(mesh.vertices);
  for (int triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    const std::array<int, 3>& corners = at(mesh.triangles, triangle);
    traced.faces.emplace_back(corners.begin(), corners.end());
    for (int k = 0; k < 3; ++k) {
      // An edge that two triangles share is listed by the first.
      const int neighbour = mesh.neighbour(triangle, k);
      if (neighbour >= 0 && neighbour < triangle) continue;
      traced.edges.push_back({at(corners, k), at(corners, (k + 1) % 3)});
    }
  }
  const Aabb<S> bounds = mesh.tree.bounds();
  traced.center_of_mass = bounds.center().template cast<double>();
}

}  // namespace

template <class S>
trace::Shape traced_shape(const ScenarioShape& shape, const Shape<S>& rounded) {
  trace::Shape traced;
  traced.name = shape.name;
  traced.type = shape.type;
  const auto describe_kind = [&](const auto& kind) { describe(kind, traced); };
  if (shape.is_moved())
    std::visit(describe_kind, *shape.geometry);
  else
    std::visit(describe_kind, rounded);
  return traced;
}

template trace::Shape traced_shape(const ScenarioShape&, const Shape<float>&);
template trace::Shape traced_shape(const ScenarioShape&, const Shape<double>&);

}  // namespace contactscope

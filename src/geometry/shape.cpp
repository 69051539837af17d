#include "geometry/shape.h"

namespace contactscope {
namespace {

/// Distance of a shape's centre from its origin, in radii, beyond which it is moved. Below, that
/// costs at most two of float's 24 bits, and the shape stays bit for bit.
constexpr double kFarthestMiddle = 4;

/// Spheres are centred at the origin, and planes have no size.
template <class Other> Vec3d origin_for(const Other&) { return Vec3d::Zero(); }
Vec3d origin_for(const Capsule<double>& capsule) {
  return middle_where_far(box_around(capsule.points), capsule.radius);
}
Vec3d origin_for(const Hull<double>& hull) {
  return middle_where_far(box_around(hull.vertices), 0);
}
Vec3d origin_for(const Mesh<double>& mesh) { return middle_where_far(mesh.tree.bounds(), 0); }

Vec3d origin_for(const Field<double>& field) { return moved_origin(field.source->shape); }

std::shared_ptr<const FieldSource<double>> source_of(Shape<double> shape) {
  return std::make_shared<const FieldSource<double>>(FieldSource<double>{std::move(shape)});
}

void move(Sphere<double>&, const Vec3d&) {}

void move(HalfSpace<double>& half_space, const Vec3d& origin) {
  half_space.plane.offset -= half_space.plane.normal.dot(origin);
}

void move(Capsule<double>& capsule, const Vec3d& origin) {
  for (Vec3d& point : capsule.points) point -= origin;
}

void move(Hull<double>& hull, const Vec3d& origin) {
  for (Vec3d& vertex : hull.vertices) vertex -= origin;
  for (Plane<double>& plane : hull.planes) plane.offset -= plane.normal.dot(origin);
  hull.centroid -= origin;
  lay_out(hull);
}

void move(Mesh<double>& mesh, const Vec3d& origin) {
  for (Vec3d& vertex : mesh.vertices) vertex -= origin;
  refit(mesh);
}

void move(Field<double>& field, const Vec3d& origin) {
  field.origin -= origin;
  field.source = source_of(seen_from(field.source->shape, origin));
}

void scale(Sphere<double>& sphere, double factor) { sphere.radius *= factor; }

void scale(HalfSpace<double>& half_space, double factor) { half_space.plane.offset *= factor; }

void scale(Capsule<double>& capsule, double factor) {
  for (Vec3d& point : capsule.points) point *= factor;
  capsule.radius *= factor;
}

void scale(Hull<double>& hull, double factor) {
  for (Vec3d& vertex : hull.vertices) vertex *= factor;
  for (Plane<double>& plane : hull.planes) plane.offset *= factor;
  hull.centroid *= factor;
  hull.radius *= factor;
  lay_out(hull);
}

void scale(Mesh<double>& mesh, double factor) {
  for (Vec3d& vertex : mesh.vertices) vertex *= factor;
  refit(mesh);
}

void scale(Field<double>& field, double factor) {
  field.origin *= factor;
  field.cell *= factor;
  field.source = source_of(scaled(field.source->shape, factor));
}

}  // namespace

Vec3d middle_where_far(const Aabb<double>& box, double margin) {
  const Vec3d middle = box.center();
  const double radius = 0.5 * box.extent().norm() + margin;
  if (middle.norm() <= kFarthestMiddle * radius) return Vec3d::Zero();
  // GCC 12 optimizes away the casts of a whole vector there and back, so store each number.
  Vec3d origin;
  for (int axis = 0; axis < 3; ++axis) {
    const volatile float rounded = static_cast<float>(middle[axis]);
    origin[axis] = static_cast<double>(rounded);
  }
  return origin;
}

template <class T> Shape<T> shape_cast(const Shape<double>& shape) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape))
    return Sphere<T>{static_cast<T>(sphere->radius)};
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape))
    return Capsule<T>{{capsule->points[0].cast<T>(), capsule->points[1].cast<T>()},
                      static_cast<T>(capsule->radius)};
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) return hull_cast<T>(*hull);
  if (const auto* half_space = std::get_if<HalfSpace<double>>(&shape))
    return HalfSpace<T>{half_space->plane.cast<T>()};
  if (const auto* field = std::get_if<Field<double>>(&shape))
    return Field<T>{field->values, field->origin, field->cell,
                    std::make_shared<const FieldSource<T>>(
                        FieldSource<T>{shape_cast<T>(field->source->shape)})};
  return mesh_cast<T>(std::get<Mesh<double>>(shape));
}

Vec3d moved_origin(const Shape<double>& shape) {
  return std::visit([](const auto& kind) { return origin_for(kind); }, shape);
}

Shape<double> seen_from(const Shape<double>& shape, const Vec3d& origin) {
  Shape<double> moved = shape;
  std::visit([&](auto& kind) { move(kind, origin); }, moved);
  return moved;
}

Shape<double> scaled(const Shape<double>& shape, double factor) {
  Shape<double> larger = shape;
  std::visit([&](auto& kind) { scale(kind, factor); }, larger);
  return larger;
}

template Shape<float> shape_cast(const Shape<double>&);
template Shape<double> shape_cast(const Shape<double>&);

}  // namespace contactscope
